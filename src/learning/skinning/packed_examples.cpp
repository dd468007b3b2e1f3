#include "learning/skinning/packed_examples.h"

#include <algorithm>
#include <numeric>

#include "geometry/point_sets.h"

namespace vitruvia::skinning {
namespace {

std::vector<int> RowsByLabel(std::span<const std::uint8_t> labels) {
  std::vector<int> order(labels.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return labels[a] < labels[b]; });
  return order;
}

}  // namespace

PackedExamples::PackedExamples(const Examples& examples, std::span<const std::uint8_t> labels)
    : groups_(static_cast<int>((3 * examples.poses.size() + kLanes - 1) / kLanes)),
      vertex_of_row_(RowsByLabel(labels)),
      rest_(examples.rest.size()),
      coordinates_(examples.rest.size() * static_cast<std::size_t>(stride()), 0.0f),
      rest_centroid_(Centroid(examples.rest)) {
  for (std::size_t row = 0; row < rest_.size(); ++row) {
    const Vector3d centred = examples.rest[vertex_of_row_[row]].cast<double>() - rest_centroid_;
    rest_[row] << centred.cast<float>(), 1.0f;
  }
  for (std::size_t pose = 0; pose < examples.poses.size(); ++pose) {
    const std::vector<Vector3f>& vertices = examples.poses[pose];
    pose_centroids_.push_back(Centroid(vertices));
    for (std::size_t row = 0; row < rest_.size(); ++row) {
      const Vector3d centred =
          vertices[vertex_of_row_[row]].cast<double>() - pose_centroids_.back();
      float* const at = coordinates_.data() + row * static_cast<std::size_t>(stride()) + 3 * pose;
      for (int axis = 0; axis < 3; ++axis) at[axis] = static_cast<float>(centred[axis]);
    }
  }
}

}  // namespace vitruvia::skinning
