#include "tracking/pose_search.h"

#include <numbers>

#include "math/rotation.h"

namespace vitruvia {

std::vector<Matrix3<double>> HypothesisRotations() {
  constexpr int kHeadings = 8;
  const Matrix3<double> upside_down = Vector3<double>(-1.0, -1.0, 1.0).asDiagonal();
  std::vector<Matrix3<double>> rotations;
  for (int k = 0; k < kHeadings; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kHeadings;
    const Matrix3<double> heading = ExpSo3<double>({0.0, angle, 0.0});
    rotations.push_back(heading);
    rotations.push_back(upside_down * heading);
  }
  return rotations;
}

}  // namespace vitruvia
