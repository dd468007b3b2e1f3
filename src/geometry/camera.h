// Pinhole camera without distortion. Camera frame: x right, y down, z forward, metres.
// Pixel (0, 0) has its centre at u = 0, v = 0; depth is z, not ray length.
#pragma once

#include "config/settings.h"
#include "math/rigid.h"

namespace vitruvia {

struct PinholeCamera {
  int width = 320, height = 240;                          // pixels
  double fx = 285.0, fy = 285.0, cx = 159.5, cy = 119.5;  // pixels

  template <class Scalar>
  Eigen::Matrix<Scalar, 2, 1> Project(const Vector3<Scalar>& point_in_camera) const {
    const Scalar inverse_z = Scalar(1) / point_in_camera.z();
    return {Scalar(fx) * point_in_camera.x() * inverse_z + Scalar(cx),
            Scalar(fy) * point_in_camera.y() * inverse_z + Scalar(cy)};
  }

  // The point of pixel coordinates (u, v) at depth z.
  template <class Scalar>
  Vector3<Scalar> Unproject(Scalar u, Scalar v, Scalar z) const {
    return {(u - Scalar(cx)) / Scalar(fx) * z, (v - Scalar(cy)) / Scalar(fy) * z, z};
  }

  // Whether a point lies before the camera and its pixel, rounded, in the image.
  template <class Scalar>
  bool InView(const Vector3<Scalar>& point_in_camera) const {
    if (!(point_in_camera.z() > Scalar(0))) return false;
    const auto pixel = Project(point_in_camera);
    const Scalar half(0.5);
    return pixel.x() > -half && pixel.y() > -half && pixel.x() < Scalar(width) - half &&
           pixel.y() < Scalar(height) - half;
  }

  void Describe(Fields& fields);
};

}  // namespace vitruvia
