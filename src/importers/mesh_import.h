// Converts mesh sequences from other sources: the mesh of each frame is rendered by a simulated
// depth camera; the meshes themselves are the ground truth. Meshes of constant topology with a
// known rest pose correspond to the template; otherwise each frame has a true surface with its own
// triangles.
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

// Writes the sequence (sequence/sequence.h). With a rest mesh, the true joints follow from the bone
// motions that, with the subject's skinning weights, fit the meshes best in the least-squares
// sense; without one there are no true joints. DataError naming the file if a mesh is damaged, has
// other triangles than the rest mesh, or lies behind the camera.
void ImportMeshSequence(const MeshSequenceSettings& settings, const std::filesystem::path& folder);

}  // namespace vitruvia
