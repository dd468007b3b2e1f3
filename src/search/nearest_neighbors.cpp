#include "search/nearest_neighbors.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

// Points sorted into square cells of the image (counting sort, so that each cell is a range).
class WindowNeighbors final : public NearestNeighbors {
 public:
  WindowNeighbors(const PinholeCamera& camera, int window_px)
      : camera_(camera),
        window_px_(window_px),
        columns_((camera.width + kCellPx - 1) / kCellPx),
        rows_((camera.height + kCellPx - 1) / kCellPx) {}

  void Build(const std::vector<Vector3f>& points) override {
    const std::size_t cells = static_cast<std::size_t>(columns_) * rows_;
    first_.assign(cells + 2, 0);
    cell_of_.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      cell_of_[i] = CellOf(points[i]);
      if (cell_of_[i] >= 0) ++first_[cell_of_[i] + 2];
    }
    for (std::size_t cell = 2; cell < first_.size(); ++cell) first_[cell] += first_[cell - 1];
    sorted_.resize(first_.back());
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (cell_of_[i] >= 0) {
        sorted_[first_[cell_of_[i] + 1]++] = {points[i], static_cast<std::int32_t>(i)};
      }
    }
  }

  void FindNearest(const std::vector<Vector3f>& queries, float max_distance_m,
                   std::vector<KdTree::Neighbor>& neighbors) const override {
    neighbors.assign(queries.size(), {});
    if (first_.empty()) return;
    for (std::size_t q = 0; q < queries.size(); ++q) {
      neighbors[q] = Nearest(queries[q], max_distance_m);
    }
  }

 private:
  static constexpr int kCellPx = 4;
  struct Entry {
    Vector3f point;
    std::int32_t index;
  };

  int CellOf(const Vector3f& point) const {
    const auto pixel = camera_.PixelOf(point);
    return pixel ? pixel->v / kCellPx * columns_ + pixel->u / kCellPx : -1;
  }

  KdTree::Neighbor Nearest(const Vector3f& query, float max_distance_m) const {
    KdTree::Neighbor nearest{-1, max_distance_m * max_distance_m};
    const int cell = CellOf(query);
    if (cell < 0) return {};
    const float reach_px = max_distance_m * static_cast<float>(camera_.fx) / query.z();
    const int half_px = static_cast<int>(std::min(reach_px, static_cast<float>(window_px_)));
    const int reach = (half_px + kCellPx - 1) / kCellPx;
    const int column = cell % columns_, row = cell / columns_;
    for (int y = std::max(row - reach, 0); y <= std::min(row + reach, rows_ - 1); ++y) {
      const int left = y * columns_ + std::max(column - reach, 0);
      const int right = y * columns_ + std::min(column + reach, columns_ - 1);
      for (int k = first_[left]; k < first_[right + 1]; ++k) {
        const float squared = (sorted_[k].point - query).squaredNorm();
        const bool wins = squared < nearest.squared_distance ||
                          (squared == nearest.squared_distance &&
                           (nearest.index < 0 || sorted_[k].index < nearest.index));
        if (wins) nearest = {sorted_[k].index, squared};
      }
    }
    return nearest.index < 0 ? KdTree::Neighbor{} : nearest;
  }

  PinholeCamera camera_;
  int window_px_, columns_, rows_;
  std::vector<int> first_;    // entry at which each cell begins
  std::vector<int> cell_of_;  // of each point, -1: out of view
  std::vector<Entry> sorted_;
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
