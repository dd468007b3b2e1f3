#include "tracking/cloud_parts.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/disjoint_sets.h"

namespace vitruvia {
namespace {

// Which part each point belongs to, named after the part's first point.
std::vector<int> PartOfPoints(const PointCloud& cloud, int width, int stride, double gap_m) {
  const int rows_height = cloud.pixels.empty() ? 0 : cloud.pixels.back() / width + 1;
  std::vector<int> point_at(static_cast<std::size_t>(width) * rows_height, -1);
  DisjointSets sets(cloud.points.size());
  const auto join = [&](int point, int pixel) {
    const int other = point_at[pixel];
    if (other < 0) return;
    if (std::abs(cloud.points[point].z() - cloud.points[other].z()) < gap_m)
      sets.Join(point, other);
  };
  for (int i = 0; i < static_cast<int>(cloud.points.size()); ++i) {
    const int pixel = cloud.pixels[i];
    point_at[pixel] = i;
    if (pixel % width >= stride) join(i, pixel - stride);
    if (pixel / width >= stride) join(i, pixel - stride * width);
  }
  std::vector<int> part(cloud.points.size());
  for (int i = 0; i < static_cast<int>(part.size()); ++i) part[i] = sets.Find(i);
  return part;
}

}  // namespace

std::vector<Vector3d> CentersOfParts(const PointCloud& cloud, int width, int stride, double gap_m,
                                     double min_share) {
  struct Part {
    Vector3d sum = Vector3d::Zero();
    int points = 0;
  };
  std::map<int, Part> parts;
  const std::vector<int> part_of = PartOfPoints(cloud, width, stride, gap_m);
  for (std::size_t i = 0; i < part_of.size(); ++i) {
    Part& part = parts[part_of[i]];
    part.sum += cloud.points[i].cast<double>();
    ++part.points;
  }
  std::vector<Part> large;
  for (const auto& [first, part] : parts) {
    if (part.points >= min_share * static_cast<double>(part_of.size())) large.push_back(part);
  }
  std::stable_sort(large.begin(), large.end(),
                   [](const Part& a, const Part& b) { return a.points > b.points; });
  std::vector<Vector3d> centers;
  for (const Part& part : large) centers.push_back(part.sum / part.points);
  return centers;
}

}  // namespace vitruvia
