#include "tracking/visibility.h"

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
  visible.resize(vertices_in_camera.size() + kLanes);  // Compress writes further ones behind
  const float* depths = rendered.pixels().data();
  std::size_t count = 0, i = 0;
  for (; i + kLanes <= vertices_in_camera.size(); i += kLanes) {
    const PointLanes points = LoadPoints(vertices_in_camera[i].data());
    const IntLanes pixels = PixelsOf(camera, points);
    const FloatLanes there = Gather(depths, pixels < 0 ? IntLanes{} : pixels);
    const IntLanes is_visible =
        (pixels >= 0) & (there > 0.0f) & (Abs(points.z - there) < tolerance_m);
    count += Compress(CountFrom(static_cast<int>(i)), is_visible, &visible[count]);
  }
  for (; i < vertices_in_camera.size(); ++i) {
    const Vector3f& vertex = vertices_in_camera[i];
    const auto pixel = camera.PixelOf(vertex);
    const float there = pixel ? rendered(pixel->u, pixel->v) : 0.0f;
    if (there > 0.0f && std::abs(vertex.z() - there) < tolerance_m) {
      visible[count++] = static_cast<int>(i);
    }
  }
  visible.resize(count);
}

}  // namespace vitruvia
