#include "metrics/nearest_vertices.h"

#include <limits>

#include "search/kd_tree.h"

namespace vitruvia {

std::vector<int> NearestVertices(const std::vector<Vector3f>& points,
                                 const std::vector<Vector3f>& vertices) {
  KdTree tree;
  tree.Build(vertices);
  std::vector<KdTree::Neighbor> neighbors;
  tree.FindNearest(points, std::numeric_limits<float>::infinity(), neighbors);
  std::vector<int> nearest;
  for (const KdTree::Neighbor& neighbor : neighbors) nearest.push_back(neighbor.index);
  return nearest;
}

}  // namespace vitruvia
