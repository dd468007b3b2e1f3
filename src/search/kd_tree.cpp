#include "search/kd_tree.h"

#include <optional>

#include <flann/flann.hpp>

namespace vitruvia {
namespace {
constexpr int kLeafSize = 10;  // tuned: FLANN's own default; 5 … 20 make no measurable difference
using Distance = flann::L2_Simple<float>;
}  // namespace

struct KdTree::Tree {
  std::vector<float> coordinates;  // FLANN keeps a pointer to the points
  std::optional<flann::KDTreeSingleIndex<Distance>> index;
};

KdTree::KdTree() : tree_(std::make_unique<Tree>()) {}
KdTree::~KdTree() = default;
KdTree::KdTree(KdTree&&) noexcept = default;
KdTree& KdTree::operator=(KdTree&&) noexcept = default;

void KdTree::Build(const std::vector<Vector3f>& points) {
  tree_->index.reset();
  if (points.empty()) return;
  tree_->coordinates.assign(points.front().data(), points.front().data() + 3 * points.size());
  tree_->index.emplace(flann::Matrix<float>(tree_->coordinates.data(), points.size(), 3),
                       flann::KDTreeSingleIndexParams(kLeafSize));
  tree_->index->buildIndex();
}

void KdTree::FindNearest(const std::vector<Vector3f>& queries, float max_distance,
                         std::vector<Neighbor>& neighbors) const {
  neighbors.assign(queries.size(), {});
  if (!tree_->index) return;
  const flann::SearchParams exact(flann::FLANN_CHECKS_UNLIMITED, 0.0f, false);
  flann::KNNRadiusResultSet<float> nearest(max_distance * max_distance, 1);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    nearest.clear();
    tree_->index->findNeighbors(nearest, queries[i].data(), exact);
    if (nearest.size() == 0) continue;
    std::size_t index = 0;
    nearest.copy(&index, &neighbors[i].squared_distance, 1);
    neighbors[i].index = static_cast<int>(index);
  }
}

}  // namespace vitruvia
