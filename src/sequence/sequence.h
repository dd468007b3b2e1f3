// The sequence format: depth frames of one subject with what is known of their ground truth.
//
//   sequence.json        format, version, camera, depth_unit_m, fps, frames, joints, surface,
//                        subject, provenance
//   depth/000000.png     16-bit, × depth_unit_m metres along z, 0 = no measurement
//   mask/000000.png      optional, 8-bit: 0 = background; all frames have one or none has
//   truth/joints.json    per frame and joint: position (camera frame, metres), visible flag
//   truth/mesh.ply       triangles and rest pose (subject frame) of the true surface
//   truth/vertices.bin   float32 [frames][vertices][3], camera frame, metres, little-endian
//   subject/             what a tracker may know (see body/body_model.h)
//
// True joints, the true surface and the subject are there or not, as sequence.json says.
//
// FORMAT.md beside this file tells users how to bring their own data.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "body/body_model.h"
#include "geometry/camera.h"
#include "geometry/image.h"

namespace vitruvia {

struct SequenceInfo {
  PinholeCamera camera;
  double depth_unit_m = 0.001;
  double fps = 30.0;
  int frames = 0;
  std::vector<std::string> joints;  // names, in the order of truth/joints.json; none: no such file
  bool surface = true;              // whether the true surface is there: mesh.ply and vertices.bin
  bool subject = true;              // whether there is a subject/
  nlohmann::json provenance = nlohmann::json::object();  // how it was made; free form
};

struct JointTruth {
  std::vector<Vector3<double>> positions;  // camera frame, metres
  std::vector<bool> visible;  // seen by the camera: not behind anything, not out of view
  // Whether the recording holds the joint in this frame; where not, its position means nothing and
  // it is not visible. Empty: all are known.
  std::vector<bool> known{};

  bool Knows(std::size_t joint) const { return known.empty() || known[joint]; }
};

// Reads lazily: construction checks the small files and the sizes of the large ones, frames are
// decoded on demand. All members throw DataError naming the file and what is wrong with it.
class SequenceReader {
 public:
  explicit SequenceReader(std::filesystem::path folder);

  const std::filesystem::path& folder() const { return folder_; }
  const SequenceInfo& info() const { return info_; }
  // DataError that says what to do if the sequence has none.
  const BodyModel& subject() const;
  DepthImage ReadDepth(int frame) const;  // mask applied where there is one
  // Only where info() says that there are true joints or a true surface.
  const JointTruth& true_joints(int frame) const;
  const TriangleMesh& true_rest_mesh() const;
  std::vector<Vector3f> ReadTrueVertices(int frame) const;
  // Of every file's name and content, in sorted order, 16 hex digits. The provenance is left out:
  // the same data made again by another build has the same hash.
  std::string hash() const;

 private:
  void RequireFrame(int frame) const;
  void RequireSurface() const;
  void ReadTruth();

  std::filesystem::path folder_;
  SequenceInfo info_;
  bool has_masks_ = false;
  BodyModel subject_;
  TriangleMesh true_rest_mesh_;
  std::vector<JointTruth> true_joints_;
};

// Writes a sequence whole or not at all: everything goes to a temporary folder that Publish() moves
// into place.
class SequenceWriter {
 public:
  SequenceWriter(std::filesystem::path folder, SequenceInfo info, const BodyModel& subject,
                 const TriangleMesh& true_rest_mesh);
  // Without a true surface: frames are appended without vertices.
  SequenceWriter(std::filesystem::path folder, SequenceInfo info,
                 const std::optional<BodyModel>& subject);
  ~SequenceWriter();

  // Sizes must be those of the camera, the mesh and info.joints; values must be finite. DataError
  // with counts if depth does not fit 16 bits of info.depth_unit_m.
  void Append(const DepthImage& depth, const std::vector<Vector3f>& true_vertices,
              const JointTruth& joints);
  void Append(const DepthImage& depth, const JointTruth& joints);
  // Adds what only came to light on the way to the provenance.
  void Note(const std::string& key, nlohmann::json value);
  // Writes what remains after the last frame. Returns the temporary folder, where the sequence can
  // be read and checked. std::logic_error unless exactly info.frames frames were appended.
  std::filesystem::path Complete();
  void Publish();  // after Complete(); things may be noted in between
  void Finish();   // both

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Decodes everything. Throws DataError at the first damaged or inconsistent piece.
void VerifySequence(const std::filesystem::path& folder);

}  // namespace vitruvia
