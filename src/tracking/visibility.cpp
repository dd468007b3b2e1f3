#include "tracking/visibility.h"

#include <algorithm>
#include <cmath>

#include "math/lanes.h"

namespace vitruvia {
namespace {

// PinholeCamera::PixelOf for eight points: v · width + u, −1 where it has nothing.
IntLanes PixelsOf(const PinholeCamera& camera, const PointLanes& points) {
  const auto fx = static_cast<float>(camera.fx), fy = static_cast<float>(camera.fy);
  const auto cx = static_cast<float>(camera.cx), cy = static_cast<float>(camera.cy);
  const auto width = static_cast<float>(camera.width), height = static_cast<float>(camera.height);
  constexpr float kHalf = 0.5f;
  const FloatLanes inverse_z = 1.0f / points.z;
  const FloatLanes u = fx * points.x * inverse_z + cx, v = fy * points.y * inverse_z + cy;
  const IntLanes is_in_view = (points.z > 0.0f) & (u >= -kHalf) & (v >= -kHalf) &
                              (u < width - kHalf) & (v < height - kHalf);
  // What is out of view may be too large for an integer.
  const IntLanes column = Truncate(is_in_view ? u + kHalf : FloatLanes{});
  const IntLanes row = Truncate(is_in_view ? v + kHalf : FloatLanes{});
  return is_in_view ? row * camera.width + column : IntLanes{} - 1;
}

}  // namespace

void FindVisibleVertices(const std::vector<Vector3f>& vertices_in_camera,
                         const DepthImage& rendered, const PinholeCamera& camera, float tolerance_m,
                         std::vector<int>& visible) {
  visible.resize(vertices_in_camera.size());
  std::size_t count = 0;
  // Branch-free, to avoid mispredictions: a vertex that is not visible is overwritten by the next.
  const auto look = [&](std::size_t vertex, int pixel, float z) {
    const float there = rendered.pixels()[std::max(pixel, 0)];
    visible[count] = static_cast<int>(vertex);
    const bool is_visible = (pixel >= 0) & (there > 0.0f) & (std::abs(z - there) < tolerance_m);
    count += is_visible ? 1 : 0;
  };
  std::size_t i = 0;
  for (; i + kLanes <= vertices_in_camera.size(); i += kLanes) {
    const PointLanes points = LoadPoints(vertices_in_camera[i].data());
    const IntLanes pixels = PixelsOf(camera, points);
    for (std::size_t lane = 0; lane < kLanes; ++lane) look(i + lane, pixels[lane], points.z[lane]);
  }
  for (; i < vertices_in_camera.size(); ++i) {
    const auto pixel = camera.PixelOf(vertices_in_camera[i]);
    look(i, pixel ? pixel->v * camera.width + pixel->u : -1, vertices_in_camera[i].z());
  }
  visible.resize(count);
}

}  // namespace vitruvia
