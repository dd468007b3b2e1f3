#include "tracking/visibility.h"

#include <cmath>

namespace vitruvia {

void FindVisibleVertices(const std::vector<Vector3f>& vertices_in_camera,
                         const DepthImage& rendered, const PinholeCamera& camera, float tolerance_m,
                         std::vector<int>& visible) {
  visible.clear();
  for (std::size_t i = 0; i < vertices_in_camera.size(); ++i) {
    const Vector3f& point = vertices_in_camera[i];
    const auto pixel = camera.PixelOf(point);
    if (!pixel) continue;
    const float z = rendered(pixel->u, pixel->v);
    if (z > 0.0f && std::abs(point.z() - z) < tolerance_m) visible.push_back(static_cast<int>(i));
  }
}

}  // namespace vitruvia
