#include "articulated/cloud_normals.h"

#include <cmath>

namespace vitruvia::articulated {

void FindNormals(const PointCloud& cloud, const DepthImage& depth, const PinholeCamera& camera,
                 int step_px, std::vector<Vector3f>& normals) {
  constexpr float kOneSurface_m = 0.06f;
  normals.assign(cloud.points.size(), Vector3f::Zero());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const int u = cloud.pixels[i] % camera.width, v = cloud.pixels[i] / camera.width;
    const bool is_inside =
        u >= step_px && v >= step_px && u + step_px < camera.width && v + step_px < camera.height;
    if (!is_inside) continue;
    const float z = cloud.points[i].z();
    const auto at = [&](int du, int dv) {
      return camera.Unproject(static_cast<float>(u + du), static_cast<float>(v + dv),
                              depth(u + du, v + dv));
    };
    const Vector3f left = at(-step_px, 0), right = at(step_px, 0), above = at(0, -step_px),
                   below = at(0, step_px);
    const auto is_near = [&](const Vector3f& p) { return std::abs(p.z() - z) < kOneSurface_m; };
    if (!is_near(left) || !is_near(right) || !is_near(above) || !is_near(below)) continue;
    normals[i] = (below - above).cross(right - left).normalized();
  }
}

}  // namespace vitruvia::articulated
