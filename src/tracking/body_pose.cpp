#include "tracking/body_pose.h"

#include <Eigen/LU>

namespace vitruvia {

Matrix3<double> RelativeRotation(const Matrix3<double>& a, const Matrix3<double>& b) {
  constexpr double kRounding = 1e-10;
  const Matrix3<double> defect = a.transpose() * a - Matrix3<double>::Identity();
  if (defect.norm() < kRounding) return a.transpose() * b;
  return a.inverse() * b;
}

}  // namespace vitruvia
