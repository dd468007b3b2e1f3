// Derivatives of rotation vectors.
#pragma once

#include <cmath>

#include "math/rotation.h"

namespace vitruvia {

// The inverse of the right Jacobian of the exponential map: log(exp(d) exp(e)) ≈ d + J⁻¹(d) e. For
// angles below 2π.
inline Matrix3<double> InverseRightJacobian(const Vector3<double>& rotation_vector) {
  const double angle = rotation_vector.norm();
  const Matrix3<double> skew = Skew<double>(rotation_vector);
  const double second = angle < 1e-4
                            ? 1.0 / 12.0
                            : 1.0 / (angle * angle) - 1.0 / (2.0 * angle * std::tan(0.5 * angle));
  return Matrix3<double>::Identity() + 0.5 * skew + second * skew * skew;
}

}  // namespace vitruvia
