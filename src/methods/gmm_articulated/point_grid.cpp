#include "methods/gmm_articulated/point_grid.h"

#include <cmath>

namespace vitruvia::gmm_articulated {

Eigen::Array3i PointGrid::CellOf(const Vector3f& place) const {
  constexpr float kFar = 1e6f;  // cells; keeps what lies anywhere within the range of int
  return ((place - origin_) * inverse_cell_).array().floor().max(-kFar).min(kFar).cast<int>();
}

// A counting sort.
void PointGrid::Build(const std::vector<Vector3f>& points, float cell_m) {
  constexpr float kMostPerAxis = 96.0f;
  const Eigen::AlignedBox3f box = BoundingBox(points);
  const Vector3f sizes = points.empty() ? Vector3f::Zero() : Vector3f(box.sizes());
  const float cell = std::max(cell_m, sizes.maxCoeff() / kMostPerAxis);
  origin_ = points.empty() ? Vector3f::Zero() : Vector3f(box.min());
  inverse_cell_ = 1.0f / cell;
  size_ = (sizes * inverse_cell_).array().floor().cast<int>() + 1;
  first_.assign(static_cast<std::size_t>(size_.prod()) + 1, 0);
  cells_.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Array3i at = CellOf(points[i]).min(size_ - 1).max(0);
    cells_[i] = (at.z() * size_.y() + at.y()) * size_.x() + at.x();
    ++first_[cells_[i] + 1];
  }
  for (std::size_t cell_index = 1; cell_index < first_.size(); ++cell_index) {
    first_[cell_index] += first_[cell_index - 1];
  }
  indices_.resize(points.size());
  x_.resize(points.size());
  y_.resize(points.size());
  z_.resize(points.size());
  // Backwards, so that `first_` ends as the beginning of each cell.
  for (std::size_t i = points.size(); i-- > 0;) {
    const int at = --first_[cells_[i] + 1];
    indices_[at] = static_cast<int>(i);
    x_[at] = points[i].x();
    y_[at] = points[i].y();
    z_[at] = points[i].z();
  }
  // Each cell's beginning now stands one place too far.
  first_.erase(first_.begin());
  first_.push_back(static_cast<int>(points.size()));
}

}  // namespace vitruvia::gmm_articulated
