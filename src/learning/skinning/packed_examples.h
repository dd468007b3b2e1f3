// Examples in the memory layout of the alternation: one contiguous row of floats per vertex.
//
// Each pose, and the rest pose, is shifted to have its centroid at the origin: floats then resolve
// a body in metres to 0.1 µm wherever it stands. Rows are sorted by label, so that neighbouring
// rows read the same bones.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "learning/skinning/examples.h"
#include "math/lanes.h"

namespace vitruvia::skinning {

// Rows are padded with zeros to multiples of kLanes floats.
using Lanes = Eigen::Array<float, kLanes, 1>;

// A point of the rest pose in homogeneous coordinates (x, y, z, 1).
using RestPoint = Eigen::Matrix<float, 4, 1, Eigen::DontAlign>;

class PackedExamples {
 public:
  PackedExamples(const Examples& examples, std::span<const std::uint8_t> labels);

  int vertex_count() const { return static_cast<int>(vertex_of_row_.size()); }
  int pose_count() const { return static_cast<int>(pose_centroids_.size()); }
  int groups() const { return groups_; }  // of lanes in a row
  int stride() const { return groups_ * kLanes; }

  // x, y, z of pose 0, of pose 1, …, then zeros.
  const float* Row(int row) const {
    return coordinates_.data() + static_cast<std::ptrdiff_t>(row) * stride();
  }
  const RestPoint& Rest(int row) const { return rest_[row]; }
  int VertexOfRow(int row) const { return vertex_of_row_[row]; }

  const Vector3d& rest_centroid() const { return rest_centroid_; }
  const Vector3d& PoseCentroid(int pose) const { return pose_centroids_[pose]; }

 private:
  int groups_ = 0;
  std::vector<int> vertex_of_row_;
  std::vector<RestPoint> rest_;
  std::vector<float, Eigen::aligned_allocator<float>> coordinates_;
  Vector3d rest_centroid_;
  std::vector<Vector3d> pose_centroids_;
};

}  // namespace vitruvia::skinning
