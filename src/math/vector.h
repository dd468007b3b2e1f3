// Vectors and matrices of three dimensions.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>  // cross products

namespace vitruvia {

template <class Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;
template <class Scalar>
using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;

// Defined in math/rigid.h; this declaration suffices for headers that only name it.
template <class Scalar>
struct Rigid;
using Rigidd = Rigid<double>;
using Rigidf = Rigid<float>;

}  // namespace vitruvia
