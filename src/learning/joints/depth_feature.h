// Depth features of a joint detector: differences of two depths near a point.
//
// f = d(π(x + u)) − d(π(x + w)) (Shotton et al. 2011), with offsets u and w in metres across the
// line of sight, so that f does not depend on the distance to the camera; or f = d(π(x + u)) −
// z(x), the surface's depth relative to the point. A missing measurement counts as kBackground_m
// behind the point, and all depths are clamped to within kBackground_m of the point.
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/camera.h"
#include "geometry/image.h"
#include "geometry/mesh.h"

namespace vitruvia::joints {

inline constexpr float kBackground_m = 1.0f;

// A part of a depth image in millimetres: `left` and `top` are the columns and rows cut off.
struct CroppedDepth {
  Image<std::uint16_t> depth_mm;  // 0 = no measurement
  int left = 0, top = 0;

  float At(int u, int v) const {  // metres, 0: no measurement
    const int x = u - left, y = v - top;
    return depth_mm.Contains(x, y) ? 1e-3f * static_cast<float>(depth_mm(x, y)) : 0.0f;
  }
};

// A whole depth image in metres, divided by the person's size: a person so many times larger and
// farther away looks the same.
struct WholeDepth {
  const DepthImage& depth;
  float max_depth_m;
  float size;

  float At(int u, int v) const {
    if (!depth.Contains(u, v)) return 0.0f;
    const float z = depth(u, v);
    return z > 0.0f && z <= max_depth_m ? z / size : 0.0f;  // also false of NaN
  }
};

// A point in front of the camera, with its projection, as features need it.
struct FeaturePoint {
  FeaturePoint(const PinholeCamera& camera, const Vector3f& point)
      : z(std::max(point.z(), kNearest_m)),
        u(static_cast<float>(camera.fx) * point.x() / z + static_cast<float>(camera.cx)),
        v(static_cast<float>(camera.fy) * point.y() / z + static_cast<float>(camera.cy)),
        columns_per_m(static_cast<float>(camera.fx) / z),
        rows_per_m(static_cast<float>(camera.fy) / z) {}

  static constexpr float kNearest_m = 0.1f;
  float z, u, v, columns_per_m, rows_per_m;
};

enum class FeatureKind : std::int32_t { kTwoDepths, kDepthAgainstPoint };

struct DepthFeature {
  FeatureKind kind = FeatureKind::kDepthAgainstPoint;
  float x = 0.0f, y = 0.0f;              // u, metres
  float other_x = 0.0f, other_y = 0.0f;  // w, metres; of kTwoDepths

  template <class View>
  float Of(const View& view, const FeaturePoint& point) const {
    const float first = Depth(view, point, x, y);
    return kind == FeatureKind::kTwoDepths ? first - Depth(view, point, other_x, other_y) : first;
  }

 private:
  // Relative to the point's depth, metres.
  template <class View>
  static float Depth(const View& view, const FeaturePoint& point, float dx, float dy) {
    const float z = view.At(static_cast<int>(std::lround(point.u + point.columns_per_m * dx)),
                            static_cast<int>(std::lround(point.v + point.rows_per_m * dy)));
    if (z == 0.0f) return kBackground_m;
    return std::clamp(z - point.z, -kBackground_m, kBackground_m);
  }
};

}  // namespace vitruvia::joints
