// Accumulates distances to one direction of a MutualDistance.
#pragma once

#include <algorithm>
#include <cmath>

#include "fitting/fit_target.h"

namespace vitruvia {

// Distance between two surfaces' points as MutualDistance defines it.
inline double SurfaceDistance(const Vector3f& apart, const Vector3f& normal, double spacing_m) {
  return std::max<double>(std::abs(normal.dot(apart)), apart.norm() - spacing_m);
}

struct DistanceSum {
  double sum_m = 0.0, near = 0.0, all = 0.0;

  void Add(double distance_m, double weight, const NearFar& limits) {
    sum_m += weight * std::min(distance_m, limits.far_m);
    if (distance_m <= limits.near_m) near += weight;
    all += weight;
  }
  // Mean distance, or none_m if nothing was added.
  double MeanOr(double none_m) const { return all > 0.0 ? sum_m / all : none_m; }
  double share() const { return all > 0.0 ? near / all : 0.0; }
};

}  // namespace vitruvia
