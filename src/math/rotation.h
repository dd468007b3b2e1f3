// Rotations.
#pragma once

#include <cmath>

#include <Eigen/Geometry>

#include "math/vector.h"

namespace vitruvia {

// The matrix with Skew(a) b = a × b.
template <class Scalar>
Matrix3<Scalar> Skew(const Vector3<Scalar>& a) {
  Matrix3<Scalar> m;
  m << Scalar(0), -a.z(), a.y(), a.z(), Scalar(0), -a.x(), -a.y(), a.x(), Scalar(0);
  return m;
}

// Rotation by |r| radians about r/|r| (Rodrigues). Exact to rounding at and near zero.
template <class Scalar>
Matrix3<Scalar> ExpSo3(const Vector3<Scalar>& r) {
  using std::cos, std::sin, std::sqrt;
  const Scalar angle_squared = r.squaredNorm();
  Scalar a, b;  // sin(t)/t and (1 − cos t)/t²
  if (angle_squared < Scalar(1e-8)) {
    a = Scalar(1) - angle_squared / Scalar(6);
    b = Scalar(0.5) - angle_squared / Scalar(24);
  } else {
    const Scalar angle = sqrt(angle_squared);
    a = sin(angle) / angle;
    b = (Scalar(1) - cos(angle)) / angle_squared;
  }
  const Matrix3<Scalar> k = Skew<Scalar>(r);
  return Matrix3<Scalar>::Identity() + a * k + b * k * k;
}

// The rotation vector of R with angle in [0, π]; inverse of ExpSo3 there.
template <class Scalar>
Vector3<Scalar> LogSo3(const Matrix3<Scalar>& rotation) {
  const Eigen::AngleAxis<Scalar> angle_axis(Eigen::Quaternion<Scalar>(rotation).normalized());
  return angle_axis.angle() * angle_axis.axis();
}

// The rotation nearest to M in the Frobenius norm (polar decomposition by SVD).
template <class Scalar>
Matrix3<Scalar> NearestRotation(const Matrix3<Scalar>& m) {
  const Eigen::JacobiSVD<Matrix3<Scalar>> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3<Scalar> u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < Scalar(0)) u.col(2) *= Scalar(-1);
  return u * svd.matrixV().transpose();
}

// The smallest rotation that turns direction `from` into direction `to`.
template <class Scalar>
Matrix3<Scalar> RotationBetween(const Vector3<Scalar>& from, const Vector3<Scalar>& to) {
  return Eigen::Quaternion<Scalar>::FromTwoVectors(from, to).toRotationMatrix();
}

}  // namespace vitruvia
