// Distances added up to one side of a MutualDistance.
#pragma once

#include <algorithm>
#include <cmath>

#include "fitting/fit_target.h"

namespace vitruvia {

// Of two points of surfaces (see MutualDistance).
inline double SurfaceDistance(const Vector3f& apart, const Vector3f& normal, double spacing_m) {
  return std::max<double>(std::abs(normal.dot(apart)), apart.norm() - spacing_m);
}

struct DistanceSum {
  double sum_m = 0.0;
  int near = 0, count = 0;

  void Add(double distance_m, const NearFar& limits) {
    sum_m += std::min(distance_m, limits.far_m);
    near += distance_m <= limits.near_m;
    ++count;
  }
  // Of nothing: as far as can be, and nothing explained.
  double MeanOr(double none_m) const { return count == 0 ? none_m : sum_m / count; }
  double share() const { return count == 0 ? 0.0 : static_cast<double>(near) / count; }
};

}  // namespace vitruvia
