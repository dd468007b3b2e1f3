#include "synth/motions/mocap_performer.h"

#include <cmath>
#include <set>

#include "core/error.h"
#include "synth/motions/mocap_figure.h"

namespace vitruvia {
namespace {

using Vector3d = Vector3<double>;
using Eigen::Quaterniond;
using enum BoneId;

// Scaled and in the subject's axes.
void MoveToSubject(MocapClip& clip, const MocapAxes& axes, double metres_per_unit) {
  const Quaterniond world(axes.subject_from_world), rest(axes.subject_from_rest);
  for (MocapJoint& joint : clip.joints) {
    joint.offset = metres_per_unit * (axes.subject_from_rest * joint.offset);
    joint.tip = metres_per_unit * (axes.subject_from_rest * joint.tip);
  }
  for (MocapFrame& frame : clip.frames) {
    frame.root_position = metres_per_unit * (axes.subject_from_world * frame.root_position);
    for (std::size_t i = 0; i < frame.rotations.size(); ++i) {
      frame.rotations[i] = (i == 0 ? world : rest) * frame.rotations[i] * rest.conjugate();
    }
    for (Vector3d& offset : frame.offsets) {
      offset = metres_per_unit * (axes.subject_from_rest * offset);
    }
  }
}

// Turned to face the front in the first frame, with the pelvis above the origin. Returns where the
// front was before.
Vector3d MoveToStart(MocapClip& clip, const MocapJoints& joints) {
  const MocapPose first = PoseOf(clip, clip.frames[0]);
  const std::size_t pelvis = joints.At(kPelvis);
  const Vector3d facing = first.rotations[pelvis].col(2);
  const Quaterniond front(
      Eigen::AngleAxisd(-std::atan2(facing.x(), facing.z()), Vector3d::UnitY()));
  const Vector3d start(first.positions[pelvis].x(), 0.0, first.positions[pelvis].z());
  for (MocapFrame& frame : clip.frames) {
    frame.root_position = front * (frame.root_position - start);
    frame.rotations[0] = front * frame.rotations[0];
  }
  return front.conjugate() * Vector3d::UnitZ();
}

}  // namespace

void MocapSettings::Describe(Fields& f) {
  DescribeUpAxis(f, up_axis);
  f.List("joints", joints,
         {.meaning = "mapping of joints of the motion capture file whose names are not known "
                     "(synth/motions/mocap_rigs.cpp lists the known names)"});
}

std::string MocapSettings::Problem() const {
  std::set<std::string> ours, of_file;
  for (const MocapJointName& name : joints) {
    if (!ours.insert(name.ours).second) {
      return fmt::format(
          "joints: {} is named twice; expected one joint of the file for each of "
          "the skeleton",
          name.ours);
    }
    if (!of_file.insert(name.file).second) {
      return fmt::format("joints: the file's joint {} is named twice", name.file);
    }
  }
  return "";
}

double LegLength(const Skeleton& skeleton) {
  const auto at = [&](BoneId bone) -> const Vector3d& {
    return skeleton.joints[static_cast<std::size_t>(bone)];
  };
  return 0.5 *
         ((at(kLeftShin) - at(kLeftThigh)).norm() + (at(kLeftFoot) - at(kLeftShin)).norm() +
          (at(kRightShin) - at(kRightThigh)).norm() + (at(kRightFoot) - at(kRightShin)).norm());
}

std::vector<std::string> MocapPerformer::Warnings() const {
  std::vector<std::string> warnings = clip.warnings;
  if (!axes.warning.empty()) {
    warnings.push_back(fmt::format("{}: {}", clip.file.string(), axes.warning));
  }
  warnings.insert(warnings.end(), check.warnings.begin(), check.warnings.end());
  return warnings;
}

MocapPerformer Understand(MocapClip clip, const MocapSettings& settings, const Skeleton& skeleton) {
  MocapPerformer performer;
  performer.joints = FindMocapJoints(clip, settings.joints);
  performer.axes = FindAxes(clip, performer.joints, settings.up_axis);
  performer.metres_per_unit =
      LegLength(skeleton) / LegLength(RestPositions(clip), performer.joints);
  MoveToSubject(clip, performer.axes, performer.metres_per_unit);
  const Vector3d front = MoveToStart(clip, performer.joints);
  performer.facing = performer.axes.subject_from_world.transpose() * front;
  performer.check = CheckClip(clip, performer.joints);
  performer.clip = std::move(clip);
  return performer;
}

}  // namespace vitruvia
