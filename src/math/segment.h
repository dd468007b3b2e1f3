// A straight line segment.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/vector.h"

namespace vitruvia {

struct Segment {
  Vector3<double> from, to;

  double SquaredDistance(const Vector3<double>& point) const {
    const Vector3<double> along = to - from;
    const double share =
        std::clamp((point - from).dot(along) / std::max(along.squaredNorm(), 1e-12), 0.0, 1.0);
    return (point - from - share * along).squaredNorm();
  }
  double Distance(const Vector3<double>& point) const { return std::sqrt(SquaredDistance(point)); }
};

}  // namespace vitruvia
