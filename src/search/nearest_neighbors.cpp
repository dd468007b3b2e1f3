#include "search/nearest_neighbors.h"

#include <array>
#include <limits>

#include "search/pixel_grid.h"

namespace vitruvia {
namespace {

constexpr float kFarAway = 1e18f;  // where no point is: squares still fit a float

class KdTreeNeighbors final : public NearestNeighbors {
 public:
  void Build(const std::vector<Vector3f>& points) override { tree_.Build(points); }
  void FindNearest(const std::vector<Vector3f>& queries, float max_distance_m,
                   std::vector<KdTree::Neighbor>& neighbors) const override {
    tree_.FindNearest(queries, max_distance_m, neighbors);
  }

 private:
  KdTree tree_;
};

// Coordinates in three arrays, filled up to whole groups with points far away.
class ExhaustiveNeighbors final : public NearestNeighbors {
 public:
  void Build(const std::vector<Vector3f>& points) override {
    const std::size_t groups = (points.size() + kGroup - 1) / kGroup;
    x_.assign(groups * kGroup, kFarAway);
    y_ = z_ = x_;
    for (std::size_t i = 0; i < points.size(); ++i) {
      x_[i] = points[i].x();
      y_[i] = points[i].y();
      z_[i] = points[i].z();
    }
  }

  void FindNearest(const std::vector<Vector3f>& queries, float max_distance_m,
                   std::vector<KdTree::Neighbor>& neighbors) const override {
    neighbors.resize(queries.size());
    for (std::size_t q = 0; q < queries.size(); ++q) {
      neighbors[q] = Nearest(queries[q], max_distance_m * max_distance_m);
    }
  }

 private:
  static constexpr std::size_t kGroup = 8;

  // Each lane keeps its own nearest; the lanes are compared at the end.
  KdTree::Neighbor Nearest(const Vector3f& query, float max_squared) const {
    std::array<float, kGroup> best;
    std::array<std::int32_t, kGroup> where;
    best.fill(std::numeric_limits<float>::infinity());
    where.fill(-1);
    for (std::size_t i = 0; i < x_.size(); i += kGroup) {
      for (std::size_t k = 0; k < kGroup; ++k) {
        const float dx = x_[i + k] - query.x(), dy = y_[i + k] - query.y();
        const float dz = z_[i + k] - query.z();
        const float squared = dx * dx + dy * dy + dz * dz;
        where[k] = squared < best[k] ? static_cast<std::int32_t>(i + k) : where[k];
        best[k] = squared < best[k] ? squared : best[k];
      }
    }
    KdTree::Neighbor nearest{-1, std::numeric_limits<float>::infinity()};
    for (std::size_t k = 0; k < kGroup; ++k) {
      const bool wins = best[k] < nearest.squared_distance ||
                        (best[k] == nearest.squared_distance && where[k] < nearest.index);
      if (where[k] >= 0 && wins) nearest = {where[k], best[k]};
    }
    return nearest.squared_distance <= max_squared ? nearest : KdTree::Neighbor{};
  }

  std::vector<float> x_, y_, z_;
};

class WindowNeighbors final : public NearestNeighbors {
 public:
  WindowNeighbors(const PinholeCamera& camera, int window_px)
      : grid_(camera), window_px_(window_px) {}

  void Build(const std::vector<Vector3f>& points) override { grid_.Build(points); }
  void FindNearest(const std::vector<Vector3f>& queries, float max_distance_m,
                   std::vector<KdTree::Neighbor>& neighbors) const override {
    grid_.FindNearest(queries, max_distance_m, window_px_, neighbors);
  }

 private:
  PixelGrid grid_;
  int window_px_;
};

}  // namespace

std::unique_ptr<NearestNeighbors> MakeNearestNeighbors(Association association,
                                                       const PinholeCamera& camera, int window_px) {
  switch (association) {
    case Association::kKdTree:
      return std::make_unique<KdTreeNeighbors>();
    case Association::kWindow:
      return std::make_unique<WindowNeighbors>(camera, window_px);
    case Association::kExhaustive:
      break;
  }
  return std::make_unique<ExhaustiveNeighbors>();
}

}  // namespace vitruvia
