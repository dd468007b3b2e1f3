// Rigid transforms.
//
// A transform carries its frames in its name: `b_from_a` maps coordinates in a to coordinates in b,
// `c_from_b * b_from_a` is `c_from_a`, `Inverse(b_from_a)` is `a_from_b`.
#pragma once

#include "math/vector.h"

namespace vitruvia {

template <class Scalar>
struct Rigid {
  Matrix3<Scalar> rotation = Matrix3<Scalar>::Identity();
  Vector3<Scalar> translation = Vector3<Scalar>::Zero();

  Vector3<Scalar> operator*(const Vector3<Scalar>& point) const {
    return rotation * point + translation;
  }
  Rigid operator*(const Rigid& b_from_a) const {
    return {rotation * b_from_a.rotation, rotation * b_from_a.translation + translation};
  }
  template <class Other>
  Rigid<Other> Cast() const {
    return {rotation.template cast<Other>(), translation.template cast<Other>()};
  }
};

template <class Scalar>
Rigid<Scalar> Inverse(const Rigid<Scalar>& b_from_a) {
  return {b_from_a.rotation.transpose(), -(b_from_a.rotation.transpose() * b_from_a.translation)};
}

// The transform that turns by `rotation` about a fixed point.
template <class Scalar>
Rigid<Scalar> RotationAbout(const Matrix3<Scalar>& rotation, const Vector3<Scalar>& center) {
  return {rotation, center - rotation * center};
}

}  // namespace vitruvia
