#include "synth/motions/keyframes_pose.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "math/angles.h"
#include "math/rotation.h"

namespace vitruvia {
namespace {

constexpr const char* kSideNames[kSideCount] = {"left", "right"};

Matrix3<double> Rotation(double x_deg, double y_deg, double z_deg) {
  return ExpSo3<double>(kRadiansPerDegree * Vector3<double>(x_deg, y_deg, z_deg));
}

Matrix3<double>& Of(JointPose& pose, BoneId bone) {
  return pose.local_rotations[static_cast<std::size_t>(bone)];
}

// A hanging limb's swing and axial rotation. `outward` is +1 on the left, where x points away from
// the body, and −1 on the right.
Matrix3<double> LimbRotation(double flexion, double abduction, double internal, double outward) {
  return Rotation(-flexion, 0.0, outward * abduction) * Rotation(0.0, -outward * internal, 0.0);
}

void SetArm(const std::array<double, kSideAngleCount>& a, double outward, BoneId upper_arm,
            JointPose& joints) {
  const auto bone = [&](int step) {
    return static_cast<BoneId>(static_cast<int>(upper_arm) + step);
  };
  const Matrix3<double> hanging_from_rest = Rotation(0.0, 0.0, -outward * 90.0);
  Of(joints, bone(0)) =
      LimbRotation(a[kShoulderFlexion], a[kShoulderAbduction], a[kShoulderRotation], outward) *
      hanging_from_rest;
  const Matrix3<double> half_pronation = Rotation(0.5 * a[kPronation], 0.0, 0.0);
  Of(joints, bone(1)) = Rotation(0.0, -outward * a[kElbowFlexion], 0.0) * half_pronation;
  Of(joints, bone(2)) =
      half_pronation * Rotation(0.0, outward * a[kUlnarDeviation], -outward * a[kWristFlexion]);
}

void SetLeg(const std::array<double, kSideAngleCount>& a, double outward, BoneId thigh,
            JointPose& joints) {
  const auto bone = [&](int step) { return static_cast<BoneId>(static_cast<int>(thigh) + step); };
  Of(joints, bone(0)) = LimbRotation(a[kHipFlexion], a[kHipAbduction], a[kHipRotation], outward);
  Of(joints, bone(1)) = Rotation(a[kKneeFlexion], 0.0, 0.0);
  Of(joints, bone(2)) = Rotation(-a[kDorsiflexion], 0.0, -outward * a[kInversion]);
}

// One joint's angles in a list of angles.
struct JointAngles {
  const JointInfo& joint;
  double* angles_deg;

  void Describe(Fields& f) {
    for (std::size_t i = 0; i < joint.angles.size(); ++i) {
      const AngleInfo& angle = joint.angles[i];
      f.Number(angle.key, angles_deg[static_cast<std::size_t>(joint.first) + i],
               {.meaning = angle.meaning,
                .unit = "deg",
                .min = angle.min_deg,
                .max = angle.max_deg,
                .source = angle.source});
    }
  }
};

void DescribeJoint(Fields& f, const std::string& name, const JointInfo& joint, double* angles_deg) {
  JointAngles angles{joint, angles_deg};
  f.Section(name.c_str(), angles, {.meaning = "joint angles"});
}

std::string SideName(int side, const JointInfo& joint) {
  return fmt::format("{}_{}", kSideNames[side], joint.name);
}

}  // namespace

AnatomicalPose Mirrored(const AnatomicalPose& pose) {
  AnatomicalPose mirrored = pose;
  for (const int angle : {kSpineBend, kSpineTurn, kNeckBend, kNeckTurn}) {
    mirrored.midline_deg[static_cast<std::size_t>(angle)] *= -1.0;
  }
  std::swap(mirrored.sides_deg[kLeft], mirrored.sides_deg[kRight]);
  return mirrored;
}

void SetRotations(const AnatomicalPose& pose, JointPose& joints) {
  const auto& m = pose.midline_deg;
  const Matrix3<double> half_spine =
      Rotation(0.5 * m[kSpineFlexion], 0.5 * m[kSpineTurn], -0.5 * m[kSpineBend]);
  const Matrix3<double> half_neck =
      Rotation(0.5 * m[kNeckFlexion], 0.5 * m[kNeckTurn], -0.5 * m[kNeckBend]);
  Of(joints, BoneId::kAbdomen) = Of(joints, BoneId::kChest) = half_spine;
  Of(joints, BoneId::kNeck) = Of(joints, BoneId::kHead) = half_neck;
  SetArm(pose.sides_deg[kLeft], 1.0, BoneId::kLeftUpperArm, joints);
  SetArm(pose.sides_deg[kRight], -1.0, BoneId::kRightUpperArm, joints);
  SetLeg(pose.sides_deg[kLeft], 1.0, BoneId::kLeftThigh, joints);
  SetLeg(pose.sides_deg[kRight], -1.0, BoneId::kRightThigh, joints);
}

MentionedAngles::MentionedAngles() {
  constexpr double kNotMentioned = std::numeric_limits<double>::quiet_NaN();
  midline_deg.fill(kNotMentioned);
  for (auto& side : sides_deg) side.fill(kNotMentioned);
  both_sides_deg.fill(kNotMentioned);
}

void MentionedAngles::Describe(Fields& f) {
  for (const JointInfo& joint : MidlineJoints()) {
    DescribeJoint(f, joint.name, joint, midline_deg.data());
  }
  for (const JointInfo& joint : SideJoints()) {
    DescribeJoint(f, joint.plural, joint, both_sides_deg.data());
    for (int side = 0; side < kSideCount; ++side) {
      DescribeJoint(f, SideName(side, joint), joint,
                    sides_deg[static_cast<std::size_t>(side)].data());
    }
  }
}

std::string MentionedAngles::Problem() const {
  for (const JointInfo& joint : SideJoints()) {
    for (std::size_t i = 0; i < joint.angles.size(); ++i) {
      const std::size_t angle = static_cast<std::size_t>(joint.first) + i;
      if (std::isnan(both_sides_deg[angle])) continue;
      for (int side = 0; side < kSideCount; ++side) {
        if (std::isnan(sides_deg[static_cast<std::size_t>(side)][angle])) continue;
        return fmt::format("{0} of the {1} is given twice: by \"{2}\" and by \"{1}\"",
                           joint.angles[i].key, SideName(side, joint), joint.plural);
      }
    }
  }
  return "";
}

void MentionedAngles::ApplyTo(AnatomicalPose& pose) const {
  const auto apply = [](const auto& mentioned, auto& angles) {
    for (std::size_t i = 0; i < angles.size(); ++i) {
      if (!std::isnan(mentioned[i])) angles[i] = mentioned[i];
    }
  };
  apply(midline_deg, pose.midline_deg);
  for (std::size_t side = 0; side < kSideCount; ++side) {
    apply(both_sides_deg, pose.sides_deg[side]);
    apply(sides_deg[side], pose.sides_deg[side]);
  }
}

}  // namespace vitruvia
