#include "search/pixel_grid.h"

#include <algorithm>
#include <cmath>

namespace vitruvia {

PixelGrid::PixelGrid(const PinholeCamera& camera)
    : camera_(camera),
      columns_((camera.width + kCellPx - 1) / kCellPx),
      rows_((camera.height + kCellPx - 1) / kCellPx) {}

// A counting sort, so that each cell is a range.
void PixelGrid::Build(const std::vector<Vector3f>& points) {
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

void PixelGrid::FindNearest(const std::vector<Vector3f>& queries, float max_distance_m,
                            int window_px, std::vector<KdTree::Neighbor>& neighbors) const {
  neighbors.assign(queries.size(), {});
  if (first_.empty()) return;
  for (std::size_t q = 0; q < queries.size(); ++q) {
    neighbors[q] = Nearest(queries[q], max_distance_m, window_px);
  }
}

int PixelGrid::CellOf(const Vector3f& point) const {
  const auto pixel = camera_.PixelOf(point);
  return pixel ? pixel->v / kCellPx * columns_ + pixel->u / kCellPx : -1;
}

KdTree::Neighbor PixelGrid::Nearest(const Vector3f& query, float max_distance_m,
                                    int window_px) const {
  KdTree::Neighbor nearest{-1, max_distance_m * max_distance_m};
  const int cell = CellOf(query);
  if (cell < 0) return {};
  const float reach_px = max_distance_m * static_cast<float>(camera_.fx) / query.z();
  const int half_px = static_cast<int>(std::min(reach_px, static_cast<float>(window_px)));
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

}  // namespace vitruvia
