#include "synth/sensor/surface_angle.h"

#include <algorithm>
#include <cmath>

namespace vitruvia {
namespace {

// The surface's tangent along a row (du = 1) or column (dv = 1): between both neighbours where both
// are on the surface, to one of them otherwise; 0 if there is none.
Vector3f Tangent(const DepthImage& depth, const PinholeCamera& camera, int u, int v, int du,
                 int dv) {
  const auto point = [&](int x, int y) {
    return camera.Unproject(static_cast<float>(x), static_cast<float>(y), depth(x, y));
  };
  const auto belongs = [&](int x, int y) {
    return depth.Contains(x, y) && AreOnOneSurface(depth(u, v), depth(x, y));
  };
  const bool before = belongs(u - du, v - dv), after = belongs(u + du, v + dv);
  const Vector3f from = before ? point(u - du, v - dv) : point(u, v);
  const Vector3f to = after ? point(u + du, v + dv) : point(u, v);
  return to - from;
}

}  // namespace

Image<float> IncidenceAngles(const DepthImage& depth, const PinholeCamera& camera) {
  Image<float> angles(depth.width(), depth.height());
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      const float z = depth(u, v);
      if (!(z > 0.0f)) continue;
      const Vector3f normal =
          Tangent(depth, camera, u, v, 1, 0).cross(Tangent(depth, camera, u, v, 0, 1));
      const Vector3f ray = camera.Unproject(static_cast<float>(u), static_cast<float>(v), 1.0f);
      const float scale = normal.norm() * ray.norm();
      if (scale == 0.0f) continue;
      angles(u, v) = std::acos(std::min(std::abs(normal.dot(ray)) / scale, 1.0f));
    }
  }
  return angles;
}

bool IsAtEdge(const DepthImage& depth, int u, int v) {
  const float z = depth(u, v);
  for (int y = v - 1; y <= v + 1; ++y) {
    for (int x = u - 1; x <= u + 1; ++x) {
      if (!depth.Contains(x, y)) continue;
      const float other = depth(x, y);
      if (z > 0.0f ? !AreOnOneSurface(z, other) : other > 0.0f) return true;
    }
  }
  return false;
}

}  // namespace vitruvia
