#include "search/nearest_neighbors.h"

#include <limits>

#include "math/lanes.h"
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

// Coordinates in three columns, filled up to whole lanes with points far away.
class ExhaustiveNeighbors final : public NearestNeighbors {
 public:
  void Build(const std::vector<Vector3f>& points) override {
    const std::size_t groups = (points.size() + kLanes - 1) / kLanes;
    x_.assign(groups * kLanes, kFarAway);
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
  // Each lane keeps its own nearest; the lanes are compared at the end.
  KdTree::Neighbor Nearest(const Vector3f& query, float max_squared) const {
    FloatLanes best = FloatLanes{} + std::numeric_limits<float>::infinity();
    IntLanes best_index = IntLanes{} - 1, index = {0, 1, 2, 3, 4, 5, 6, 7};
    const int count = static_cast<int>(x_.size());
    for (int i = 0; i < count; i += kLanes, index += kLanes) {
      const FloatLanes dx = LoadLanes<FloatLanes>(x_, i) - query.x();
      const FloatLanes dy = LoadLanes<FloatLanes>(y_, i) - query.y();
      const FloatLanes dz = LoadLanes<FloatLanes>(z_, i) - query.z();
      const FloatLanes squared = dx * dx + dy * dy + dz * dz;
      const IntLanes nearer = squared < best;
      best = nearer ? squared : best;
      best_index = nearer ? index : best_index;
    }
    const float smallest = SmallestLane(best);
    if (!(smallest <= max_squared)) return {};
    const IntLanes none = IntLanes{} + std::numeric_limits<std::int32_t>::max();
    return {SmallestLane(best == smallest ? best_index : none), smallest};
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
