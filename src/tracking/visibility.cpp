#include "tracking/visibility.h"

#include <cmath>

namespace vitruvia {

void FindVisibleVertices(const std::vector<Vector3f>& vertices_in_camera,
                         const DepthImage& rendered, const PinholeCamera& camera, float tolerance_m,
                         std::vector<int>& visible) {
  visible.clear();
  const auto width = static_cast<float>(camera.width), height = static_cast<float>(camera.height);
  for (std::size_t i = 0; i < vertices_in_camera.size(); ++i) {
    const Vector3f& point = vertices_in_camera[i];
    if (!(point.z() > 0.0f)) continue;
    const auto pixel = camera.Project(point);
    if (!(pixel.x() >= -0.5f && pixel.y() >= -0.5f && pixel.x() < width - 0.5f &&
          pixel.y() < height - 0.5f)) {
      continue;
    }
    const float z =
        rendered(static_cast<int>(pixel.x() + 0.5f), static_cast<int>(pixel.y() + 0.5f));
    if (z > 0.0f && std::abs(point.z() - z) < tolerance_m) visible.push_back(static_cast<int>(i));
  }
}

}  // namespace vitruvia
