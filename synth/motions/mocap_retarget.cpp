#include "synth/motions/mocap_retarget.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "synth/motions/mocap_contact.h"
#include "synth/motions/mocap_joints.h"

namespace vitruvia {
namespace {

using Vector3d = Vector3<double>;
using Matrix3d = Matrix3<double>;
using Eigen::Quaterniond;
using enum BoneId;

constexpr std::size_t Index(BoneId bone) { return static_cast<std::size_t>(bone); }

struct BodyFrame {
  std::array<Quaterniond, kBoneCount> local_rotations;
  Vector3d pelvis_position = Vector3d::Zero();
  double clearance_m = 0.0;
};

class CapturedMotion final : public Motion {
 public:
  CapturedMotion(std::vector<BodyFrame> frames, double frame_s)
      : frames_(std::move(frames)), frame_s_(frame_s) {}

  double duration_s() const override { return frame_s_ * static_cast<double>(frames_.size() - 1); }

  MotionSample At(double time_s) const override {
    const double place =
        std::clamp(time_s / frame_s_, 0.0, static_cast<double>(frames_.size() - 1));
    const auto before = static_cast<std::size_t>(place);
    const double share = place - static_cast<double>(before);
    const BodyFrame& a = frames_[before];
    const BodyFrame& b = frames_[std::min(before + 1, frames_.size() - 1)];
    MotionSample sample;
    for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
      sample.pose.local_rotations[bone] =
          a.local_rotations[bone].slerp(share, b.local_rotations[bone]).toRotationMatrix();
    }
    sample.pose.pelvis_position = (1.0 - share) * a.pelvis_position + share * b.pelvis_position;
    sample.clearance_m = (1.0 - share) * a.clearance_m + share * b.clearance_m;
    return sample;
  }

 private:
  std::vector<BodyFrame> frames_;
  double frame_s_;
};

// The signed coordinate axis nearest to a direction.
Vector3d NearestAxis(const Vector3d& direction) {
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return std::copysign(1.0, direction[axis]) * Vector3d::Unit(axis);
}

// --- The clip in the subject's axes and metres
// -----------------------------------------------------

double LegLength(const std::vector<Vector3d>& rest, const MocapJoints& found) {
  const auto at = [&](BoneId bone) -> const Vector3d& {
    return rest[static_cast<std::size_t>(found.joints[Index(bone)])];
  };
  return 0.5 *
         ((at(kLeftShin) - at(kLeftThigh)).norm() + (at(kLeftFoot) - at(kLeftShin)).norm() +
          (at(kRightShin) - at(kRightThigh)).norm() + (at(kRightFoot) - at(kRightShin)).norm());
}

double LegLength(const Skeleton& skeleton) {
  const auto& at = skeleton.joints;
  return 0.5 * ((at[Index(kLeftShin)] - at[Index(kLeftThigh)]).norm() +
                (at[Index(kLeftFoot)] - at[Index(kLeftShin)]).norm() +
                (at[Index(kRightShin)] - at[Index(kRightThigh)]).norm() +
                (at[Index(kRightFoot)] - at[Index(kRightShin)]).norm());
}

// Which of the file's axes are left, up and front: legs hang down, the left hip is on the left.
Matrix3d SubjectFromFile(const MocapClip& clip, const MocapJoints& found) {
  const std::vector<Vector3d> rest = RestPositions(clip);
  const auto at = [&](BoneId bone) -> const Vector3d& {
    return rest[static_cast<std::size_t>(found.joints[Index(bone)])];
  };
  const Vector3d up =
      NearestAxis(at(kLeftThigh) + at(kRightThigh) - at(kLeftFoot) - at(kRightFoot));
  Vector3d left = at(kLeftThigh) - at(kRightThigh);
  left = NearestAxis(left - left.dot(up) * up);
  Matrix3d rows;
  rows << left.transpose(), up.transpose(), left.cross(up).transpose();
  return rows;
}

// Scaled, in the subject's axes, and turned to face the front in the first frame.
MocapClip InSubjectFrame(MocapClip clip, const MocapJoints& found, double leg_length_m) {
  const double file_leg = LegLength(RestPositions(clip), found);
  if (!(file_leg > 0.0)) {
    throw DataError(fmt::format("{}: the legs have no length", clip.file.string()));
  }
  const double metres_per_unit = leg_length_m / file_leg;
  const Matrix3d axes = SubjectFromFile(clip, found);
  for (MocapJoint& joint : clip.joints) {
    joint.offset = metres_per_unit * (axes * joint.offset);
    joint.tip = metres_per_unit * (axes * joint.tip);
  }
  const Quaterniond turn(axes);
  for (MocapFrame& frame : clip.frames) {
    frame.root_position = metres_per_unit * (axes * frame.root_position);
    for (Quaterniond& rotation : frame.rotations) rotation = turn * rotation * turn.conjugate();
  }
  const MocapPose first = PoseOf(clip, clip.frames[0]);
  const auto pelvis = static_cast<std::size_t>(found.joints[Index(kPelvis)]);
  const Vector3d facing = first.rotations[pelvis].col(2);
  const Quaterniond front(
      Eigen::AngleAxisd(-std::atan2(facing.x(), facing.z()), Vector3d::UnitY()));
  const Vector3d start(first.positions[pelvis].x(), 0.0, first.positions[pelvis].z());
  for (MocapFrame& frame : clip.frames) {
    frame.root_position = front * (frame.root_position - start);
    frame.rotations[0] = front * frame.rotations[0];
  }
  return clip;
}

// --- Alignments: what turns our rest pose into the clip's
// --------------------------------------------

using Alignments = std::array<Matrix3d, kBoneCount>;

// A limb's bone: from the direction in which our skeleton has it at rest.
Matrix3d AlignLimb(const Vector3d& ours, const Vector3d& theirs) {
  if (!(ours.norm() > 0.0) || !(theirs.norm() > 0.0)) return Matrix3d::Identity();
  return RotationBetween<double>(ours, theirs);
}

// Feet stand flat in our rest pose, and only their heading differs from body to body; the slope of
// a line from ankle to toes says more about a rig's joints than about the foot.
Matrix3d AlignFoot(const Vector3d& our_foot, const Vector3d& their_shin,
                   const Vector3d& their_foot) {
  const Matrix3d rest_from_flat = RestFromFlatFoot(their_shin);
  const Vector3d flat = rest_from_flat.transpose() * their_foot;
  const auto heading = [](const Vector3d& v) { return std::atan2(v.x(), v.z()); };
  return rest_from_flat * ExpSo3<double>((heading(flat) - heading(our_foot)) * Vector3d::UnitY());
}

// The trunk stands upright in both rest poses: only limbs are aligned.
Alignments FindAlignments(const MocapClip& clip, const MocapJoints& found,
                          const Skeleton& skeleton) {
  const std::vector<Vector3d> rest = RestPositions(clip);
  const auto joint = [&](BoneId bone) {
    return static_cast<std::size_t>(found.joints[Index(bone)]);
  };
  const auto ours = [&](BoneId bone) -> Vector3d {
    return skeleton.tips[Index(bone)] - skeleton.joints[Index(bone)];
  };
  const auto theirs = [&](BoneId bone, BoneId child) -> Vector3d {
    return rest[joint(child)] - rest[joint(bone)];
  };
  Alignments alignments;
  alignments.fill(Matrix3d::Identity());
  struct Side {
    BoneId upper_arm, forearm, hand, thigh, shin, foot;
    double outward;
  };
  for (const Side& side :
       {Side{kLeftUpperArm, kLeftForearm, kLeftHand, kLeftThigh, kLeftShin, kLeftFoot, 1.0},
        Side{kRightUpperArm, kRightForearm, kRightHand, kRightThigh, kRightShin, kRightFoot,
             -1.0}}) {
    const auto align = [&](BoneId bone, BoneId child) {
      alignments[Index(bone)] = AlignLimb(ours(bone), theirs(bone, child));
    };
    align(side.upper_arm, side.forearm);
    align(side.forearm, side.hand);
    align(side.thigh, side.shin);
    align(side.shin, side.foot);
    // Finger tips droop more or less; a hand as a whole lies along ±x in our rest pose.
    alignments[Index(side.hand)] =
        AlignLimb(side.outward * Vector3d::UnitX(), clip.joints[joint(side.hand)].tip);
    alignments[Index(side.foot)] =
        AlignFoot(ours(side.foot), theirs(side.shin, side.foot), clip.joints[joint(side.foot)].tip);
  }
  return alignments;
}

// --- Frames
// ------------------------------------------------------------------------------------------

class Retargeter {
 public:
  Retargeter(const MocapClip& clip, const MocapJoints& found, const Skeleton& skeleton)
      : clip_(clip),
        found_(found),
        skeleton_(skeleton),
        alignments_(FindAlignments(clip, found, skeleton)) {}

  BodyFrame FrameOf(const MocapFrame& captured) const {
    const MocapPose pose = PoseOf(clip_, captured);
    std::array<Quaterniond, kBoneCount> turned;  // subject_from_bone
    BodyFrame frame;
    for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
      turned[bone] = SourceRotation(pose, found_.sources[bone]) * Quaterniond(alignments_[bone]);
      const int parent = Bones()[bone].parent;
      frame.local_rotations[bone] =
          parent < 0 ? turned[bone]
                     : turned[static_cast<std::size_t>(parent)].conjugate() * turned[bone];
    }
    frame.pelvis_position = PelvisPosition(pose, turned[Index(kPelvis)]);
    return frame;
  }

 private:
  static Quaterniond SourceRotation(const MocapPose& pose, const MocapBoneSource& source) {
    const Quaterniond from(pose.rotations[static_cast<std::size_t>(source.from)]);
    const Quaterniond to(pose.rotations[static_cast<std::size_t>(source.to)]);
    return from.slerp(source.share, to);
  }

  // Puts our hips where the clip's are.
  Vector3d PelvisPosition(const MocapPose& pose, const Quaterniond& pelvis) const {
    const auto at = [&](BoneId bone) -> const Vector3d& {
      return pose.positions[static_cast<std::size_t>(found_.joints[Index(bone)])];
    };
    const Vector3d hips = 0.5 * (at(kLeftThigh) + at(kRightThigh));
    const auto& ours = skeleton_.joints;
    const Vector3d our_hips = 0.5 * (ours[Index(kLeftThigh)] + ours[Index(kRightThigh)]);
    return hips + pelvis * (ours[Index(kPelvis)] - our_hips);
  }

  const MocapClip& clip_;
  const MocapJoints& found_;
  const Skeleton& skeleton_;
  const Alignments alignments_;
};

}  // namespace

std::unique_ptr<Motion> Retarget(const MocapClip& captured, const Skeleton& skeleton) {
  const MocapJoints found = FindMocapJoints(captured);
  const double leg_length_m = LegLength(skeleton);
  const MocapClip clip = InSubjectFrame(captured, found, leg_length_m);
  const Retargeter retargeter(clip, found, skeleton);
  const std::vector<double> clearances_m = Clearances(clip, found, leg_length_m);
  std::vector<BodyFrame> frames;
  frames.reserve(clip.frames.size());
  for (std::size_t i = 0; i < clip.frames.size(); ++i) {
    frames.push_back(retargeter.FrameOf(clip.frames[i]));
    frames.back().clearance_m = clearances_m[i];
  }
  return std::make_unique<CapturedMotion>(std::move(frames), clip.frame_s);
}

}  // namespace vitruvia
