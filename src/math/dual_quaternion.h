// Unit dual quaternions as rigid transforms (Kavan et al. 2007), and their blend.
#pragma once

#include <Eigen/Geometry>

#include "math/rigid.h"

namespace vitruvia {

// q_r + ε q_d. Unit when |q_r| = 1 and q_r · q_d = 0.
template <class Scalar>
struct DualQuaternion {
  Eigen::Quaternion<Scalar> real = Eigen::Quaternion<Scalar>::Identity();
  Eigen::Quaternion<Scalar> dual{Scalar(0), Scalar(0), Scalar(0), Scalar(0)};

  static DualQuaternion FromRigid(const Rigid<Scalar>& b_from_a) {
    DualQuaternion q;
    q.real = Eigen::Quaternion<Scalar>(b_from_a.rotation).normalized();
    const Vector3<Scalar>& t = b_from_a.translation;
    q.dual = Eigen::Quaternion<Scalar>(Scalar(0), t.x(), t.y(), t.z()) * q.real;
    q.dual.coeffs() *= Scalar(0.5);
    return q;
  }

  // The transform of this dual quaternion divided by the norm of its real part.
  Rigid<Scalar> ToRigid() const {
    const Scalar norm = real.norm();
    const Eigen::Quaternion<Scalar> r(real.coeffs() / norm);
    const Eigen::Quaternion<Scalar> d(dual.coeffs() / norm);
    return {r.toRotationMatrix(), Scalar(2) * (d * r.conjugate()).vec()};
  }

  // Adds w·q, or −w·q if the real parts of q and `pivot` lie in opposite hemispheres (q and −q are
  // the same transform, but blending them with another one gives different results).
  void AddWeighted(Scalar w, const DualQuaternion& q, const Eigen::Quaternion<Scalar>& pivot) {
    const Scalar signed_weight = q.real.dot(pivot) < Scalar(0) ? -w : w;
    real.coeffs() += signed_weight * q.real.coeffs();
    dual.coeffs() += signed_weight * q.dual.coeffs();
  }

  static DualQuaternion Zero() {
    DualQuaternion q;
    q.real.coeffs().setZero();
    return q;
  }
};

}  // namespace vitruvia
