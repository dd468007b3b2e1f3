#include "methods/realtime_scape/pose_step.h"

#include <algorithm>

#include "math/rotation.h"
#include "solver/block_normal_equations.h"

namespace vitruvia::realtime_scape {

PoseStep ApplyIncrement(const BodyPose& pose, const Eigen::VectorXd& increment,
                        double length_unit_m, RotationUpdate update) {
  PoseStep step;
  step.pose = pose;
  for (int j = 0; j < kBoneCount; ++j) {
    const Vector3d rotation = increment.segment<3>(kBlockSize * j);
    const Vector3d translation = length_unit_m * increment.segment<3>(kBlockSize * j + 3);
    step.pose[j].rotation = ApplyRotationIncrement(pose[j].rotation, rotation, update);
    step.pose[j].center += translation;
    step.largest_rotation_rad = std::max(step.largest_rotation_rad, rotation.norm());
    step.largest_translation_m = std::max(step.largest_translation_m, translation.norm());
  }
  return step;
}

Matrix3<double> ApplyRotationIncrement(const Matrix3<double>& rotation, const Vector3d& increment,
                                       RotationUpdate update) {
  const Matrix3<double> linear = rotation + Skew<double>(increment) * rotation;
  switch (update) {
    case RotationUpdate::kLinear:
      return linear;
    case RotationUpdate::kLinearOrthonormal:
      return NearestRotation(linear);
    case RotationUpdate::kExponential:
      break;
  }
  // Orthonormalised, so that rounding errors do not accumulate over many steps.
  return NearestRotation<double>(ExpSo3<double>(increment) * rotation);
}

bool HasDiverged(const BodyPose& pose) {
  constexpr double kLargestStretch = 0.5, kFarthest_m = 100.0;
  return !std::all_of(pose.begin(), pose.end(), [](const BonePose& bone) {
    const Matrix3<double> product = bone.rotation.transpose() * bone.rotation;
    return (product - Matrix3<double>::Identity()).norm() <= kLargestStretch &&
           bone.center.norm() <= kFarthest_m;
  });
}

}  // namespace vitruvia::realtime_scape
