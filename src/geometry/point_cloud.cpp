#include "geometry/point_cloud.h"

#include <algorithm>
#include <cmath>

#include "geometry/depth_stretches.h"

namespace vitruvia {

void CloudFromDepth(const DepthImage& depth, const PinholeCamera& camera, int stride,
                    float max_depth_m, PointCloud& cloud) {
  cloud.points.clear();
  cloud.pixels.clear();
  for (int v = 0; v < depth.height(); v += stride) {
    ForEachStretchWithDepth(depth.width(), stride, {&depth(0, v)}, [&](int begin, int end) {
      for (int u = begin; u < end; u += stride) {
        const float z = depth(u, v);
        if (!(z > 0.0f && z <= max_depth_m)) continue;
        cloud.points.push_back(camera.Unproject(static_cast<float>(u), static_cast<float>(v), z));
        cloud.pixels.push_back(v * depth.width() + u);
      }
    });
  }
}

float SampleDepth(const DepthImage& depth, float u, float v, float smooth_within_m) {
  const auto last_u = static_cast<float>(depth.width() - 1);
  const auto last_v = static_cast<float>(depth.height() - 1);
  if (!(u >= -0.5f && v >= -0.5f && u < last_u + 0.5f && v < last_v + 0.5f)) return 0.0f;
  const float left = std::floor(u), top = std::floor(v);
  if (left >= 0.0f && top >= 0.0f && left < last_u && top < last_v) {
    const int i = static_cast<int>(left), j = static_cast<int>(top);
    const float z00 = depth(i, j), z10 = depth(i + 1, j);
    const float z01 = depth(i, j + 1), z11 = depth(i + 1, j + 1);
    // Each is tested by itself: std::min and std::max skip a NaN that does not come first.
    const bool measured = z00 > 0.0f && z10 > 0.0f && z01 > 0.0f && z11 > 0.0f;
    const auto [low, high] = std::minmax({z00, z10, z01, z11});
    if (measured && high - low <= smooth_within_m) {
      const float x = u - left, y = v - top;
      return (1.0f - y) * ((1.0f - x) * z00 + x * z10) + y * ((1.0f - x) * z01 + x * z11);
    }
  }
  const float z =
      depth(static_cast<int>(std::floor(u + 0.5f)), static_cast<int>(std::floor(v + 0.5f)));
  return z > 0.0f ? z : 0.0f;
}

FloatLanes SampleDepth(const DepthImage& depth, const FloatLanes& u, const FloatLanes& v,
                       float smooth_within_m) {
  const float* pixels = depth.pixels().data();
  const int width = depth.width();
  const auto last_u = static_cast<float>(width - 1),
             last_v = static_cast<float>(depth.height() - 1);
  constexpr FloatLanes kZero{};
  const IntLanes is_in_view =
      (u >= -0.5f) & (v >= -0.5f) & (u < last_u + 0.5f) & (v < last_v + 0.5f);
  const auto depth_at = [&](const IntLanes& where, const IntLanes& pixel) {
    return where ? Gather(pixels, where ? pixel : IntLanes{}) : kZero;
  };

  const FloatLanes left = Floor(is_in_view ? u : kZero), top = Floor(is_in_view ? v : kZero);
  const IntLanes is_inside =
      is_in_view & (left >= 0.0f) & (top >= 0.0f) & (left < last_u) & (top < last_v);
  const IntLanes first = Truncate(top) * width + Truncate(left);
  const FloatLanes z00 = depth_at(is_inside, first), z10 = depth_at(is_inside, first + 1);
  const FloatLanes z01 = depth_at(is_inside, first + width);
  const FloatLanes z11 = depth_at(is_inside, first + width + 1);
  const IntLanes is_measured = (z00 > 0.0f) & (z10 > 0.0f) & (z01 > 0.0f) & (z11 > 0.0f);
  const FloatLanes low = Min(Min(z00, z10), Min(z01, z11));
  const FloatLanes high = Max(Max(z00, z10), Max(z01, z11));
  const FloatLanes x = u - left, y = v - top;
  const FloatLanes between =
      (1.0f - y) * ((1.0f - x) * z00 + x * z10) + y * ((1.0f - x) * z01 + x * z11);

  const FloatLanes column = is_in_view ? u + 0.5f : kZero, row = is_in_view ? v + 0.5f : kZero;
  const FloatLanes nearest = depth_at(is_in_view, Truncate(row) * width + Truncate(column));
  const IntLanes is_smooth = is_measured & (high - low <= smooth_within_m);
  return is_smooth ? between : (nearest > 0.0f ? nearest : kZero);
}

}  // namespace vitruvia
