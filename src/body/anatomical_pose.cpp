#include "body/anatomical_pose.h"

#include <utility>

#include "math/angles.h"
#include "math/rotation.h"

namespace vitruvia {
namespace {

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

}  // namespace vitruvia
