// Mesh sequences of others made into sequences of ours: one mesh file for each frame is rendered as
// a depth camera sees it; the meshes themselves are the truth. Meshes of one topology whose rest
// pose is known correspond to the template; others are true surfaces of their own in each frame.
#pragma once

#include <filesystem>

#include "synth/scene/scene.h"

namespace vitruvia {

enum class MeshFrame {
  kCamera,   // x right, y down, z away from the camera
  kSubject,  // y up, the floor at y = 0, the person's front to +z; `view` says where the camera is
};

struct MeshSequenceSettings {
  std::string title;
  std::filesystem::path meshes;  // folder of .obj, .ply or .off files: frames in the order of names
  // What a tracker may know: mesh.ply, subject.json, weights.bin. "": none.
  std::filesystem::path subject;
  // The frames' mesh in the subject's rest pose, subject frame. "": each frame's mesh is a surface
  // with its own triangles.
  std::filesystem::path rest;
  MeshFrame frame = MeshFrame::kSubject;
  double unit_m = 1.0;  // of the frames and the rest mesh
  ViewSettings view;
  SensorSettings sensor;
  double fps = 30.0;
  int seed = 1;

  void Describe(Fields& fields);
  std::string Problem() const;
};

// Writes the sequence (sequence/sequence.h). With a rest mesh the true joints are where the motions
// of the bones put them that explain the meshes best by the subject's own weights (least squares);
// without one there are none. DataError naming the file if a mesh is damaged, has other triangles
// than the rest mesh, or lies behind the camera.
void ImportMeshSequence(const MeshSequenceSettings& settings, const std::filesystem::path& folder);

}  // namespace vitruvia
