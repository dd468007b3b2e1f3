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
//   empty_room/000000.png   optional: depth of the room without a person, any number of frames
//   preview.png          optional: pictures for people
//   truth/surfaces/000000.ply  version 2: a true surface with its own triangles in each frame
//   views/NAME/000000.png      version 2: depth of other calibrated cameras
//
// True joints, the true surface and the subject are there or not, as sequence.json says.
//
// FORMAT.md beside this file tells users how to bring their own data.
#pragma once

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "body/body_model.h"
#include "geometry/camera.h"
#include "geometry/image.h"
#include "math/rigid.h"

namespace vitruvia {

class WorkerTeam;

// Another camera that recorded the same frames; no tracker sees it.
struct OtherView {
  std::string name;  // of its folder in views/
  PinholeCamera camera;
  Rigidd view_from_camera;  // the sequence's camera frame to the view's

  void Describe(Fields& fields);
  std::string Problem() const;
};

// A joint of the skeleton as it is known for the first frame.
struct StartJoint {
  std::string joint;
  Vector3<double> position = Vector3<double>::Zero();  // camera frame, metres

  void Describe(Fields& fields);
};

struct SequenceInfo {
  PinholeCamera camera;
  double depth_unit_m = 0.001;
  double fps = 30.0;
  int frames = 0;
  std::vector<std::string> joints;  // names, in the order of truth/joints.json; none: no such file
  bool surface = true;              // whether the true surface is there: mesh.ply and vertices.bin
  bool subject = true;              // whether there is a subject/
  // Version 2. A true surface of its own triangles in each frame, instead of `surface`.
  bool own_surfaces = false;
  std::vector<OtherView> views;
  std::vector<StartJoint> start_pose;  // what a tracker may know of the first frame; empty: nothing
  double start_pose_accuracy_m = std::numeric_limits<double>::quiet_NaN();
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
  bool has_masks() const { return has_masks_; }
  MaskImage ReadMask(int frame) const;            // only where there are masks
  DepthImage ReadDepthWithRoom(int frame) const;  // no mask applied
  // Only where info() says that there are true joints or a true surface.
  const JointTruth& true_joints(int frame) const;
  const TriangleMesh& true_rest_mesh() const;
  std::vector<Vector3f> ReadTrueVertices(int frame) const;
  TriangleMesh ReadTrueSurface(int frame) const;        // camera frame; only with own_surfaces
  DepthImage ReadViewDepth(int view, int frame) const;  // of info().views[view]
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
  // With a true surface of the frame's own triangles, camera frame.
  void Append(const DepthImage& depth, const TriangleMesh& true_surface, const JointTruth& joints);
  // Frames of a sequence without any truth, written by all threads of the team.
  void Append(const std::vector<DepthImage>& depths, WorkerTeam& team);
  // The mask of a frame that was appended: all frames have one or none has. Several threads may
  // write masks of different frames.
  void WriteMask(int frame, const MaskImage& mask) const;
  // Depth of info.views[view].
  void WriteViewDepth(int view, int frame, const DepthImage& depth) const;
  // A frame of the room without a person, from 0.
  void WriteEmptyRoom(int frame, const DepthImage& depth) const;
  // Pictures for people, as the bytes of a PNG file.
  void WritePreview(std::string_view png) const;
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
