// Points sorted into cubic cells, so that those near a place are visited in contiguous runs.
#pragma once

#include <algorithm>
#include <vector>

#include "geometry/mesh.h"

namespace vitruvia::gmm_articulated {

class PointGrid {
 public:
  // Cells of cell_m; larger ones if there would be too many.
  void Build(const std::vector<Vector3f>& points, float cell_m);

  // The points in their order in the grid, coordinate by coordinate, and their old numbers.
  const std::vector<float>& x() const { return x_; }
  const std::vector<float>& y() const { return y_; }
  const std::vector<float>& z() const { return z_; }
  const std::vector<int>& indices() const { return indices_; }

  // Calls run(begin, end) for ranges of that order which together hold every point within cell_m of
  // the place.
  template <class Run>
  void ForRunsNear(const Vector3f& place, const Run& run) const {
    const Eigen::Array3i cell = CellOf(place);
    const int from_x = std::max(cell.x() - 1, 0), to_x = std::min(cell.x() + 1, size_.x() - 1);
    if (from_x > to_x) return;
    for (int k = std::max(cell.z() - 1, 0); k <= std::min(cell.z() + 1, size_.z() - 1); ++k) {
      for (int j = std::max(cell.y() - 1, 0); j <= std::min(cell.y() + 1, size_.y() - 1); ++j) {
        const int row = (k * size_.y() + j) * size_.x();
        const int begin = first_[row + from_x], end = first_[row + to_x + 1];
        if (begin < end) run(begin, end);
      }
    }
  }

 private:
  Eigen::Array3i CellOf(const Vector3f& place) const;

  Vector3f origin_ = Vector3f::Zero();
  float inverse_cell_ = 1.0f;
  Eigen::Array3i size_ = Eigen::Array3i::Zero();
  std::vector<int> first_, cells_, indices_;
  std::vector<float> x_, y_, z_;
};

}  // namespace vitruvia::gmm_articulated
