#include "methods/dynamic/placement.h"

#include <algorithm>
#include <limits>

#include "math/rigid.h"

namespace vitruvia::dynamic {
namespace {

template <class Predicate>
Vector3d MeanWhere(const std::vector<Vector3f>& points, const Predicate& is_counted) {
  Vector3d sum = Vector3d::Zero();
  double count = 0.0;
  for (const Vector3f& p : points) {
    if (!is_counted(p)) continue;
    sum += p.cast<double>();
    count += 1.0;
  }
  return sum / std::max(count, 1.0);
}

}  // namespace

Rigidd UprightPlacement(const std::vector<Vector3f>& rest_vertices,
                        const std::vector<Vector3f>& cloud) {
  const Vector3d cloud_mean = MeanWhere(cloud, [](const Vector3f&) { return true; });
  const Vector3d front_mean =
      MeanWhere(rest_vertices, [](const Vector3f& p) { return p.z() > 0.0f; });
  float top = std::numeric_limits<float>::infinity(), crown = -top;
  for (const Vector3f& p : cloud) top = std::min(top, p.y());
  for (const Vector3f& p : rest_vertices) crown = std::max(crown, p.y());
  Rigidd placement;
  placement.rotation = Vector3d(1.0, -1.0, -1.0).asDiagonal();
  placement.translation = {cloud_mean.x() - front_mean.x(), double{top} + double{crown},
                           cloud_mean.z() + front_mean.z()};
  return placement;
}

}  // namespace vitruvia::dynamic
