#include "methods/realtime_scape/pose_step.h"

#include <algorithm>

namespace vitruvia::realtime_scape {

Matrix3<double> Turned(const Matrix3<double>& rotation, const Vector3d& step,
                       RotationUpdate update) {
  const Matrix3<double> linear = rotation + Skew<double>(step) * rotation;
  switch (update) {
    case RotationUpdate::kLinear:
      return linear;
    case RotationUpdate::kLinearOrthonormal:
      return NearestRotation(linear);
    case RotationUpdate::kExponential:
      break;
  }
  // Rounding errors of many steps would add up.
  return NearestRotation<double>(ExpSo3<double>(step) * rotation);
}

bool IsTornApart(const BodyPose& pose) {
  constexpr double kLargestStretch = 0.5, kFarthest_m = 100.0;
  return !std::all_of(pose.begin(), pose.end(), [](const BonePose& bone) {
    const Matrix3<double> product = bone.rotation.transpose() * bone.rotation;
    return (product - Matrix3<double>::Identity()).norm() <= kLargestStretch &&
           bone.center.norm() <= kFarthest_m;
  });
}

}  // namespace vitruvia::realtime_scape
