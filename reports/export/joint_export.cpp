#include "reports/export/joint_export.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "body/skeleton.h"
#include "core/error.h"
#include "core/files.h"
#include "scoring/bone_placement.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr double kCentimetres = 100.0;

std::string TruthColumns(const SequenceReader& sequence, int frame, std::string_view joint,
                         const Vector3d& estimate) {
  const std::vector<std::string>& names = sequence.info().joints;
  const auto found = std::ranges::find(names, joint);
  if (found == names.end()) return ",,,,";
  const auto j = static_cast<std::size_t>(found - names.begin());
  const JointTruth& truth = sequence.true_joints(frame);
  if (!truth.Knows(j)) return ",,,,";
  const Vector3d& p = truth.positions[j];
  return fmt::format("{:.6f},{:.6f},{:.6f},{:d},{:.6f}", p.x(), p.y(), p.z(),
                     static_cast<bool>(truth.visible[j]), (estimate - p).norm());
}

Vector3d Upright(const Vector3d& camera_point) {
  return {camera_point.x(), -camera_point.y(), -camera_point.z()};
}

// A pose in upright axes, metres.
struct UprightPose {
  std::vector<Matrix3<double>> rotations;  // from the rest pose
  std::vector<Vector3d> positions;
};

UprightPose PoseOf(const ExportedRun& run, int frame, const BonePlacement& bones) {
  const Matrix3<double> upright_from_camera = Vector3d(1.0, -1.0, -1.0).asDiagonal();
  UprightPose pose;
  for (const Rigidd& bone : bones.Fit(run.estimate.ReadVertices(frame)))
    pose.rotations.push_back(upright_from_camera * bone.rotation);
  for (const Vector3d& joint : run.estimate.frames()[frame].joints)
    pose.positions.push_back(Upright(joint));
  return pose;
}

std::string VectorText(const Vector3d& v) {
  return fmt::format("{:.5f} {:.5f} {:.5f}", v.x(), v.y(), v.z());
}

// From the parent at rest, centimetres.
Vector3d RestOffset(const Skeleton& skeleton, int bone) {
  const int parent = Bones()[bone].parent;
  const Vector3d origin = parent < 0 ? Vector3d(Vector3d::Zero()) : skeleton.joints[parent];
  return kCentimetres * (skeleton.joints[bone] - origin);
}

// A joint with all that hangs on it. `order` takes the joints as their channels follow each other.
std::string HierarchyText(const Skeleton& skeleton, int bone, const std::string& indent,
                          std::vector<int>& order) {
  order.push_back(bone);
  std::string text = fmt::format(
      "{0}{1} {2}\n{0}{{\n{0}  OFFSET {3}\n{0}  CHANNELS 6 Xposition Yposition Zposition "
      "Zrotation Xrotation Yrotation\n",
      indent, Bones()[bone].parent < 0 ? "ROOT" : "JOINT", Bones()[bone].name,
      VectorText(RestOffset(skeleton, bone)));
  bool is_leaf = true;
  for (int child = bone + 1; child < kBoneCount; ++child) {
    if (Bones()[child].parent != bone) continue;
    text += HierarchyText(skeleton, child, indent + "  ", order);
    is_leaf = false;
  }
  if (is_leaf) {
    const Vector3d tip = kCentimetres * (skeleton.tips[bone] - skeleton.joints[bone]);
    text += fmt::format("{0}  End Site\n{0}  {{\n{0}    OFFSET {1}\n{0}  }}\n", indent,
                        VectorText(tip));
  }
  return text + indent + "}\n";
}

std::string ChannelText(const UprightPose& pose, int bone) {
  const int parent = Bones()[bone].parent;
  Vector3d position = pose.positions[bone];
  Matrix3<double> rotation = pose.rotations[bone];
  if (parent >= 0) {
    position = pose.rotations[parent].transpose() * (position - pose.positions[parent]);
    rotation = pose.rotations[parent].transpose() * rotation;
  }
  const Vector3d turns_deg = rotation.eulerAngles(2, 0, 1) * 180.0 / std::numbers::pi;
  return VectorText(kCentimetres * position) + " " + VectorText(turns_deg);
}

}  // namespace

int ExportJointTable(const fs::path& experiment_folder, const std::string& run_id,
                     std::vector<int> frames, const fs::path& file) {
  const ExportedRun run = OpenForExport(experiment_folder, run_id, std::move(frames));
  std::string text = "frame,time_s,joint,x_m,y_m,z_m,true_x_m,true_y_m,true_z_m,visible,error_m\n";
  for (const int frame : run.frames) {
    const std::vector<Vector3d>& joints = run.estimate.frames()[frame].joints;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const std::string_view name = Bones()[j].joint;
      text += fmt::format("{},{:.6f},{},{:.6f},{:.6f},{:.6f},{}\n", frame,
                          frame / run.sequence.info().fps, name, joints[j].x(), joints[j].y(),
                          joints[j].z(), TruthColumns(run.sequence, frame, name, joints[j]));
    }
  }
  WriteWholeFile(file, text);
  return static_cast<int>(run.frames.size());
}

int ExportBvh(const ExportedRun& run, const BodyModel& subject, const fs::path& file) {
  const BonePlacement bones(run.estimate.rest_mesh().vertices, subject);
  std::vector<int> order;
  std::string text = "HIERARCHY\n" + HierarchyText(subject.skeleton, 0, "", order);
  text += fmt::format("MOTION\nFrames: {}\nFrame Time: {:.6f}\n", run.frames.size(),
                      1.0 / run.sequence.info().fps);
  for (const int frame : run.frames) {
    const UprightPose pose = PoseOf(run, frame, bones);
    std::string line;
    for (const int bone : order) line += (line.empty() ? "" : " ") + ChannelText(pose, bone);
    text += line + "\n";
  }
  WriteWholeFile(file, text);
  return static_cast<int>(run.frames.size());
}

}  // namespace vitruvia
