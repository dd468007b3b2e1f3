// Truncated distances added up to one side of a MutualDistance.
#pragma once

#include <algorithm>

#include "fitting/fit_target.h"

namespace vitruvia {

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
