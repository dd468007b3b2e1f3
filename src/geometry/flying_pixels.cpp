#include "geometry/flying_pixels.h"

#include <algorithm>
#include <cmath>

namespace vitruvia {
namespace {

int CountNeighbors(const DepthImage& depth, int u, int v, float within_m) {
  const int first_u = std::max(u - 1, 0), last_u = std::min(u + 1, depth.width() - 1);
  const int first_v = std::max(v - 1, 0), last_v = std::min(v + 1, depth.height() - 1);
  const float z = depth(u, v);
  int count = -1;  // the pixel itself
  for (int y = first_v; y <= last_v; ++y) {
    for (int x = first_u; x <= last_u; ++x) {
      const float other = depth(x, y);
      count += other > 0.0f && std::abs(other - z) <= within_m ? 1 : 0;
    }
  }
  return count;
}

}  // namespace

void RemoveFlyingPixels(const DepthImage& depth, int least_neighbors, float within_m,
                        DepthImage& kept) {
  if (kept.width() != depth.width() || kept.height() != depth.height())
    kept = DepthImage(depth.width(), depth.height());
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      const float z = depth(u, v);
      const bool is_kept = z > 0.0f && CountNeighbors(depth, u, v, within_m) >= least_neighbors;
      kept(u, v) = is_kept ? z : 0.0f;
    }
  }
}

}  // namespace vitruvia
