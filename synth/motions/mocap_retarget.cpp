#include "synth/motions/mocap_retarget.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "math/rotation.h"
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
  CapturedMotion(std::vector<BodyFrame> frames, double frame_s, std::vector<std::string> warnings)
      : frames_(std::move(frames)), frame_s_(frame_s), warnings_(std::move(warnings)) {}

  double duration_s() const override { return frame_s_ * static_cast<double>(frames_.size() - 1); }
  std::vector<std::string> warnings() const override { return warnings_; }

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
  std::vector<std::string> warnings_;
};

// --- Alignments: what turns our rest pose into the clip's

using Alignments = std::array<Matrix3d, kBoneCount>;

// A limb's bone: from the direction in which our skeleton has it at rest.
Matrix3d AlignLimb(const Vector3d& ours, const Vector3d& theirs) {
  if (!(ours.norm() > 0.0) || !(theirs.norm() > 0.0)) return Matrix3d::Identity();
  return RotationBetween<double>(ours, theirs);
}

// Feet are flat in the skeleton's rest pose, and only their heading differs between bodies; the
// slope of a line from ankle to toes depends more on the rig's joints than on the foot.
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
  const auto joint = [&](BoneId bone) { return found.At(bone); };
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
      if (!captured.offsets.empty()) PointAlongLimb(bone, pose, turned[bone]);
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

  // If joints move relative to their parents, a limb's bone points from joint to joint, not in the
  // direction of its rotation alone.
  void PointAlongLimb(std::size_t bone, const MocapPose& pose, Quaterniond& turned) const {
    for (const auto& [from, to] :
         {std::pair{kLeftUpperArm, kLeftForearm}, std::pair{kLeftForearm, kLeftHand},
          std::pair{kRightUpperArm, kRightForearm}, std::pair{kRightForearm, kRightHand},
          std::pair{kLeftThigh, kLeftShin}, std::pair{kLeftShin, kLeftFoot},
          std::pair{kRightThigh, kRightShin}, std::pair{kRightShin, kRightFoot}}) {
      if (Index(from) != bone) continue;
      const Vector3d ours = turned * (skeleton_.tips[bone] - skeleton_.joints[bone]);
      const Vector3d theirs = pose.positions[found_.At(to)] - pose.positions[found_.At(from)];
      turned = Quaterniond(AlignLimb(ours, theirs)) * turned;
    }
  }

  // Puts our hips where the clip's are.
  Vector3d PelvisPosition(const MocapPose& pose, const Quaterniond& pelvis) const {
    const auto at = [&](BoneId bone) -> const Vector3d& { return pose.positions[found_.At(bone)]; };
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

std::unique_ptr<Motion> Retarget(const MocapPerformer& performer, const Skeleton& skeleton) {
  const MocapClip& clip = performer.clip;
  const Retargeter retargeter(clip, performer.joints, skeleton);
  const std::vector<double> clearances_m = Clearances(clip, performer.joints, LegLength(skeleton));
  std::vector<BodyFrame> frames;
  frames.reserve(clip.frames.size());
  for (std::size_t i = 0; i < clip.frames.size(); ++i) {
    frames.push_back(retargeter.FrameOf(clip.frames[i]));
    frames.back().clearance_m = clearances_m[i];
  }
  return std::make_unique<CapturedMotion>(std::move(frames), clip.frame_s, performer.Warnings());
}

}  // namespace vitruvia
