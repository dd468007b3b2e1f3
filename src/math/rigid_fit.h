// The rigid motion between two sets of points with known correspondences.
#pragma once

#include <cstddef>

#include "math/rigid.h"
#include "math/rotation.h"

namespace vitruvia {

struct PointPair {
  Vector3<double> in_a, in_b;
};

// b_from_a that minimises Σ |b_from_a · in_a − in_b|² (Kabsch 1976) over the pairs pair_at(0) …
// pair_at(count − 1), count ≥ 1; each pair is evaluated twice. With fewer than three pairs, or
// collinear points, the minimiser is not unique and one of them is returned.
template <class PairAt>
Rigidd FitRigid(std::size_t count, const PairAt& pair_at) {
  Vector3<double> mean_a = Vector3<double>::Zero(), mean_b = Vector3<double>::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const PointPair pair = pair_at(i);
    mean_a += pair.in_a;
    mean_b += pair.in_b;
  }
  mean_a /= static_cast<double>(count);
  mean_b /= static_cast<double>(count);
  Matrix3<double> covariance = Matrix3<double>::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const PointPair pair = pair_at(i);
    covariance += (pair.in_b - mean_b) * (pair.in_a - mean_a).transpose();
  }
  const Matrix3<double> rotation = NearestRotation(covariance);
  return {rotation, mean_b - rotation * mean_a};
}

}  // namespace vitruvia
