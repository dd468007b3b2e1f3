// Depth of planes, and what a sensor's errors on them are.
#pragma once

#include <cmath>
#include <numbers>

#include "geometry/camera.h"
#include "geometry/image.h"

namespace vitruvia {

inline constexpr double kDegree = std::numbers::pi / 180.0;
// Long focal length: the angle hardly changes over the image. Pixels are the sensor's own.
inline const PinholeCamera kNarrow{
    .width = 101, .height = 401, .fx = 580, .fy = 580, .cx = 50, .cy = 200};

// A plane through (0, 0, z_m) that is turned by angle_rad about the vertical: at the image's centre
// the angle between its normal and the ray is angle_rad.
inline DepthImage Plane(const PinholeCamera& camera, double z_m, double angle_rad) {
  DepthImage depth(camera.width, camera.height);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const double x = (u - camera.cx) / camera.fx;
      depth(u, v) = static_cast<float>(z_m / (1.0 - std::tan(angle_rad) * x));
    }
  }
  return depth;
}

struct ErrorStatistics {
  double mean_m = 0.0, deviation_m = 0.0;
  int count = 0, lost = 0;  // pixels measured, and not
};

// Over the columns within half_width of the principal point.
inline ErrorStatistics ErrorsNearCenter(const DepthImage& measured, const DepthImage& truth,
                                        const PinholeCamera& camera, int half_width) {
  ErrorStatistics s;
  double sum = 0.0, squares = 0.0;
  for (int v = 1; v + 1 < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (std::abs(u - camera.cx) > half_width) continue;
      if (measured(u, v) == 0.0f) {
        ++s.lost;
        continue;
      }
      const double error = double{measured(u, v)} - double{truth(u, v)};
      sum += error;
      squares += error * error;
      ++s.count;
    }
  }
  s.mean_m = sum / s.count;
  s.deviation_m = std::sqrt(squares / s.count - s.mean_m * s.mean_m);
  return s;
}

}  // namespace vitruvia
