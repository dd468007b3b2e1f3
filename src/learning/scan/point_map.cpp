#include "learning/scan/point_map.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vitruvia {
namespace {

constexpr double kReachInSigmas = 2.0;  // of the bilateral filter

// A bell much like exp(−x²/2) that ends at x = 2.5 and costs three multiplications.
float RangeWeight(float squared_x) {
  const float a = std::max(1.0f - squared_x / (2.5f * 2.5f), 0.0f);
  return a * a * a;
}

// The difference of points along one axis of the image; zero if neither side is the same surface.
Vector3f Slope(const Image<Vector3f>& points, int u, int v, int du, int dv, float jump_m) {
  const Vector3f& here = points(u, v);
  const auto same_surface = [&](int nu, int nv) {
    return points.Contains(nu, nv) && points(nu, nv).z() > 0.0f &&
           std::abs(points(nu, nv).z() - here.z()) <= jump_m;
  };
  const bool after = same_surface(u + du, v + dv), before = same_surface(u - du, v - dv);
  if (after && before) return points(u + du, v + dv) - points(u - du, v - dv);
  if (after) return points(u + du, v + dv) - here;
  if (before) return here - points(u - du, v - dv);
  return Vector3f::Zero();
}

}  // namespace

DepthImage Smoothed(const DepthImage& depth, const SmoothingSettings& settings, WorkerTeam& team) {
  const int reach = static_cast<int>(std::ceil(kReachInSigmas * settings.sigma_px));
  if (settings.sigma_px == 0.0) return depth;
  std::vector<float> in_image;  // weights of the window
  for (int dv = -reach; dv <= reach; ++dv) {
    for (int du = -reach; du <= reach; ++du) {
      const double d2 = (du * du + dv * dv) / (settings.sigma_px * settings.sigma_px);
      in_image.push_back(static_cast<float>(std::exp(-0.5 * d2)));
    }
  }
  const auto per_metre = static_cast<float>(1.0 / settings.sigma_m);
  DepthImage smooth(depth.width(), depth.height());
  team.For(depth.height(), [&](int begin, int end) {
    for (int v = begin; v < end; ++v) {
      for (int u = 0; u < depth.width(); ++u) {
        const float here = depth(u, v);
        if (here <= 0.0f) continue;
        float sum = 0.0f, weights = 0.0f;
        for (int dv = -reach; dv <= reach; ++dv) {
          for (int du = -reach; du <= reach; ++du) {
            if (!depth.Contains(u + du, v + dv)) continue;
            const float there = depth(u + du, v + dv);
            const float x = (there - here) * per_metre;
            if (there <= 0.0f) continue;
            const int window_index = (dv + reach) * (2 * reach + 1) + du + reach;
            const float w = in_image[static_cast<std::size_t>(window_index)] * RangeWeight(x * x);
            sum += w * there;
            weights += w;
          }
        }
        smooth(u, v) = sum / weights;
      }
    }
  });
  return smooth;
}

DepthImage Halved(const DepthImage& depth, double jump_m) {
  DepthImage half(depth.width() / 2, depth.height() / 2);
  const auto jump = static_cast<float>(jump_m);
  for (int v = 0; v < half.height(); ++v) {
    for (int u = 0; u < half.width(); ++u) {
      const std::array<float, 4> four = {depth(2 * u, 2 * v), depth(2 * u + 1, 2 * v),
                                         depth(2 * u, 2 * v + 1), depth(2 * u + 1, 2 * v + 1)};
      float nearest = 0.0f;
      for (const float d : four) {
        if (d > 0.0f && (nearest == 0.0f || d < nearest)) nearest = d;
      }
      float sum = 0.0f;
      int count = 0;
      for (const float d : four) {
        if (d <= 0.0f || d > nearest + jump) continue;
        sum += d;
        ++count;
      }
      if (count > 0) half(u, v) = sum / static_cast<float>(count);
    }
  }
  return half;
}

PinholeCamera Halved(const PinholeCamera& camera) {
  // Pixel centres are at whole numbers: the first half-size pixel's centre is at 0.5 of the old.
  return {camera.width / 2, camera.height / 2,       camera.fx / 2.0,
          camera.fy / 2.0,  (camera.cx - 0.5) / 2.0, (camera.cy - 0.5) / 2.0};
}

PointMap MakePointMap(const DepthImage& depth, const DepthImage& smooth_depth,
                      const PinholeCamera& camera, double depth_jump_m, WorkerTeam& team) {
  const int width = depth.width(), height = depth.height();
  const auto jump = static_cast<float>(depth_jump_m);
  PointMap map{Image<Vector3f>(width, height, Vector3f::Zero()),
               Image<Vector3f>(width, height, Vector3f::Zero())};
  Image<Vector3f> smooth(width, height, Vector3f::Zero());
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      if (depth(u, v) <= 0.0f) continue;
      const auto x = static_cast<float>(u), y = static_cast<float>(v);
      map.points(u, v) = camera.Unproject(x, y, depth(u, v));
      smooth(u, v) = camera.Unproject(x, y, smooth_depth(u, v));
    }
  }
  team.For(height, [&](int begin, int end) {
    for (int v = begin; v < end; ++v) {
      for (int u = 0; u < width; ++u) {
        if (depth(u, v) <= 0.0f) continue;
        const Vector3f right = Slope(smooth, u, v, 1, 0, jump);
        const Vector3f down = Slope(smooth, u, v, 0, 1, jump);
        const Vector3f normal = down.cross(right);  // x right, y down: this points at the camera
        const float length = normal.norm();
        if (length > 0.0f) map.normals(u, v) = normal / length;
      }
    }
  });
  return map;
}

}  // namespace vitruvia
