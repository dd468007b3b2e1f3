// Pinhole camera without distortion. Camera frame: x right, y down, z forward, metres.
// Pixel (0, 0) has its centre at u = 0, v = 0; depth is z, not ray length.
#pragma once

#include <optional>

#include "config/settings.h"
#include "math/vector.h"

namespace vitruvia {

// Column and row of a pixel, from 0.
struct Pixel {
  int u, v;
  bool operator==(const Pixel&) const = default;
};

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

  // The pixel whose square contains pixel coordinates (u, v), including its left and upper edges.
  // Nothing outside the image.
  template <class Scalar>
  std::optional<Pixel> PixelAt(const Eigen::Matrix<Scalar, 2, 1>& uv) const {
    constexpr Scalar half(0.5);
    if (!(uv.x() >= -half && uv.y() >= -half && uv.x() < Scalar(width) - half &&
          uv.y() < Scalar(height) - half)) {
      return std::nullopt;
    }
    return Pixel{static_cast<int>(uv.x() + half), static_cast<int>(uv.y() + half)};
  }

  // The pixel that a point falls on; nothing behind the camera or outside the image.
  template <class Scalar>
  std::optional<Pixel> PixelOf(const Vector3<Scalar>& point_in_camera) const {
    if (!(point_in_camera.z() > Scalar(0))) return std::nullopt;
    return PixelAt<Scalar>(Project(point_in_camera));
  }

  template <class Scalar>
  bool InView(const Vector3<Scalar>& point_in_camera) const {
    return PixelOf(point_in_camera).has_value();
  }

  void Describe(Fields& fields);
};

}  // namespace vitruvia
