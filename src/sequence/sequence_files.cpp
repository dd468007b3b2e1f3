#include "sequence/sequence_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>

#include "body/skeleton.h"
#include "config/stored_data.h"
#include "core/error.h"
#include "math/rigid.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr int kMostFrames = 1000000;  // six digits in the names of frames

// sequence.json. Every field that a reader depends on must be present: a default camera in place of
// a missing one would make all results wrong.
struct SequenceHeader {
  static constexpr StoredFormat kFormat{kSequenceFormat, kSequenceVersion, kFirstSequenceVersion,
                                        "write the sequence again"};

  SequenceInfo info;

  void Describe(Fields& f) {
    f.Section("camera", info.camera, {.meaning = "intrinsics of the camera"});
    f.Number("depth_unit_m", info.depth_unit_m,
             {.meaning = "metres that a depth value of 1 stands for",
              .unit = "m",
              .min = 1e-9,
              .max = 1.0});
    f.Number("fps", info.fps, {.meaning = "frames per second", .min = 1e-3, .max = 1e5});
    f.Integer("frames", info.frames, {.meaning = "number of frames", .min = 1, .max = kMostFrames});
    f.Texts(
        "joints", info.joints,
        {.meaning = "names of the true joints, in the order of truth/joints.json; an empty list "
                    "where there is no such file"});
    f.Flag("surface", info.surface,
           {.meaning = "whether there is a true surface: truth/mesh.ply and truth/vertices.bin",
            .optional = true});
    f.Flag("subject", info.subject, {.meaning = "whether there is a subject/", .optional = true});
    f.Flag("own_surfaces", info.own_surfaces,
           {.meaning = "whether there is a true surface with triangles of its own in each frame: "
                       "truth/surfaces/",
            .optional = true});
    f.List("views", info.views,
           {.meaning = "other calibrated cameras that recorded the same frames: views/",
            .optional = true});
    f.List("start_pose", info.start_pose,
           {.meaning = "joints in the first frame, as far as a tracker may know them",
            .optional = true});
    f.Number("start_pose_accuracy_m", info.start_pose_accuracy_m,
             {.meaning = "standard deviation of the start pose's joints",
              .unit = "m",
              .min = 0.0,
              .max = 1.0,
              .optional = true});
    f.FreeJson("provenance", info.provenance,
               {.meaning = "how the sequence was made", .optional = true});
  }

  std::string Problem() const { return SequenceInfoProblem(info); }
};

struct JointsOfFrame {
  std::vector<Vector3<double>> positions;  // NaN: not known
  std::vector<bool> visible;

  void Describe(Fields& f) {
    f.Points("positions", positions,
             {.meaning = "position of each joint, camera frame; null where it is not known",
              .unit = "m",
              .null_items = true});
    f.Flags("visible", visible, {.meaning = "whether the camera sees each joint"});
  }
};

// truth/joints.json. It has no header: its content is part of the hashes of stored sequences.
struct JointsFile {
  std::vector<std::string> joints;
  std::vector<JointsOfFrame> frames;

  void Describe(Fields& f) {
    f.Texts("joints", joints, {.meaning = "names of the joints, as in sequence.json"});
    f.List("frames", frames, {.meaning = "true joints of each frame"});
  }
};

// "" or what does not fit the header.
std::string JointsProblem(const JointsFile& file, const SequenceInfo& info) {
  if (file.joints != info.joints) {
    return fmt::format("joints: expected \"{}\" as in sequence.json, got \"{}\"",
                       fmt::join(info.joints, "\", \""), fmt::join(file.joints, "\", \""));
  }
  if (file.frames.size() != static_cast<std::size_t>(info.frames))
    return fmt::format("frames: expected {} items, got {}", info.frames, file.frames.size());
  const std::size_t count = info.joints.size();
  for (std::size_t i = 0; i < file.frames.size(); ++i) {
    const auto& [positions, visible] = file.frames[i];
    const auto length_problem = [&](const char* key, std::size_t length) {
      return fmt::format("frames[{}].{}: expected {} items, got {}", i, key, count, length);
    };
    if (positions.size() != count) return length_problem("positions", positions.size());
    if (visible.size() != count) return length_problem("visible", visible.size());
    for (std::size_t j = 0; j < count; ++j) {
      if (visible[j] && !positions[j].allFinite())
        return fmt::format("frames[{}]: joint \"{}\" is visible, but its position is null", i,
                           info.joints[j]);
    }
  }
  return "";
}

JointTruth TruthOf(const JointsOfFrame& joints) {
  JointTruth truth;
  truth.visible = joints.visible;
  for (const Vector3<double>& position : joints.positions) {
    const bool known = position.allFinite();
    truth.positions.push_back(known ? position : Vector3<double>::Zero());
    truth.known.push_back(known);
  }
  return truth;
}

JointsOfFrame JointsOf(const JointTruth& truth) {
  JointsOfFrame joints{truth.positions, truth.visible};
  for (std::size_t j = 0; j < truth.positions.size(); ++j) {
    if (!truth.Knows(j)) joints.positions[j].setConstant(kAbsent);
  }
  return joints;
}

}  // namespace

void OtherView::Describe(Fields& f) {
  f.Text("name", name, {.meaning = "name of the view's folder"});
  f.Section("camera", camera, {.meaning = "intrinsics of the view"});
  std::array<double, 9> rotation{};
  for (int i = 0; i < 9; ++i)
    rotation[static_cast<std::size_t>(i)] = view_from_camera.rotation(i / 3, i % 3);
  f.Numbers("rotation", rotation,
            {.meaning = "rotation of view_from_camera, row by row: a point p of the sequence's "
                        "camera frame is rotation p + translation in the view's"});
  for (int i = 0; i < 9; ++i)
    view_from_camera.rotation(i / 3, i % 3) = rotation[static_cast<std::size_t>(i)];
  std::array<double, 3> translation{};
  std::copy_n(view_from_camera.translation.data(), 3, translation.data());
  f.Numbers("translation", translation,
            {.meaning = "translation of view_from_camera", .unit = "m"});
  std::copy_n(translation.data(), 3, view_from_camera.translation.data());
}

std::string OtherView::Problem() const {
  constexpr double kOrthonormalWithin = 1e-4;
  const Matrix3<double>& r = view_from_camera.rotation;
  const double off = (r.transpose() * r - Matrix3<double>::Identity()).cwiseAbs().maxCoeff();
  if (off > kOrthonormalWithin || r.determinant() < 0.0)
    return fmt::format(
        "rotation: expected a rotation; RᵀR differs from the identity by {:.2g}, the "
        "determinant is {:.3g}",
        off, r.determinant());
  const bool is_plain = !name.empty() && name != "." && name != ".." &&
                        name.find_first_of("/\\") == std::string::npos;
  return is_plain ? "" : fmt::format("name \"{}\": expected the name of a folder", name);
}

void StartJoint::Describe(Fields& f) {
  f.Text("joint", joint, {.meaning = "name of a joint of the skeleton"});
  f.Numbers("position", std::span(position.data(), 3),
            {.meaning = "position in the camera frame", .unit = "m"});
}

std::string SequenceFiles::FrameName(int frame) { return fmt::format("{:06}.png", frame); }
std::string SequenceFiles::SurfaceName(int frame) { return fmt::format("{:06}.ply", frame); }

int VersionOf(const SequenceInfo& info) {
  const bool says_more = info.own_surfaces || !info.views.empty() || !info.start_pose.empty();
  return says_more ? kSequenceVersion : kFirstSequenceVersion;
}

std::string SequenceInfoProblem(const SequenceInfo& info) {
  if (info.camera.width < 1 || info.camera.height < 1) {
    return fmt::format("camera: an image of {}×{} pixels is empty", info.camera.width,
                       info.camera.height);
  }
  if (info.frames < 1) return "frames: the sequence is empty";
  if (!(info.depth_unit_m > 0.0) || !(info.fps > 0.0)) {
    return fmt::format("depth_unit_m is {} and fps {}, expected both above 0", info.depth_unit_m,
                       info.fps);
  }
  std::set<std::string> names;
  for (const std::string& name : info.joints) {
    if (name.empty()) return "joints: a name is empty";
    if (!names.insert(name).second) return fmt::format("joints: \"{}\" stands twice", name);
  }
  if (info.surface && info.own_surfaces)
    return "own_surfaces: there is a true surface with corresponding vertices already (surface)";
  for (const StartJoint& start : info.start_pose) {
    if (FindJoint(start.joint) < 0)
      return fmt::format("start_pose: the skeleton has no joint \"{}\"", start.joint);
  }
  if (info.start_pose.empty() != std::isnan(info.start_pose_accuracy_m))
    return "start_pose and start_pose_accuracy_m: expected both or none";
  return "";
}

SequenceInfo ReadSequenceInfo(const fs::path& file) {
  return ReadStored<SequenceHeader>(file).info;
}

Json SequenceInfoJson(const SequenceInfo& info) {
  Json json = StoredJson(SequenceHeader{info});
  json["format"] = kSequenceFormat;
  json["version"] = VersionOf(info);
  json["provenance"] = info.provenance;  // also an empty one: the hash of a sequence depends on it
  // Written only where something is missing, so that complete sequences keep their hash.
  if (info.surface) json.erase("surface");
  if (info.subject) json.erase("subject");
  if (!info.own_surfaces) json.erase("own_surfaces");
  return json;
}

std::string JointTruthProblem(const JointTruth& joints, std::size_t joint_count) {
  if (joints.positions.size() != joint_count || joints.visible.size() != joint_count) {
    return fmt::format("expected {} joints, got {} positions and {} visible flags", joint_count,
                       joints.positions.size(), joints.visible.size());
  }
  if (!joints.known.empty() && joints.known.size() != joint_count) {
    return fmt::format("expected {} joints, got {} known flags", joint_count, joints.known.size());
  }
  for (std::size_t j = 0; j < joint_count; ++j) {
    if (!joints.Knows(j) && joints.visible[j])
      return fmt::format("joint {} is visible and not known", j);
    if (joints.Knows(j) && !joints.positions[j].allFinite())
      return fmt::format("joint {} is not finite", j);
  }
  return "";
}

std::vector<JointTruth> ReadJointTruth(const fs::path& file, const SequenceInfo& info) {
  const auto joints = ReadStoredObject<JointsFile>(file);
  if (const std::string problem = JointsProblem(joints, info); !problem.empty())
    throw DataError(fmt::format("{}: {}", file.string(), problem));
  std::vector<JointTruth> truth;
  std::transform(joints.frames.begin(), joints.frames.end(), std::back_inserter(truth), TruthOf);
  return truth;
}

Json JointTruthJson(const std::vector<std::string>& names, const std::vector<JointTruth>& frames) {
  JointsFile file{names, {}};
  std::transform(frames.begin(), frames.end(), std::back_inserter(file.frames), JointsOf);
  return StoredJson(file);
}

}  // namespace vitruvia
