#include "matching/classification.h"

#include <cmath>

namespace vitruvia {

void ClassifyVertices(const std::vector<Vector3f>& vertices, const std::vector<int>& visible,
                      const DepthImage& captured, const PinholeCamera& camera, float near_m,
                      VertexClasses& classes) {
  classes.near_surface.clear();
  classes.observed_depth.clear();
  classes.elsewhere.clear();
  for (const int i : visible) {
    const Vector3f& vertex = vertices[i];
    const auto pixel = camera.Project(vertex);
    const float z = SampleDepth(captured, pixel.x(), pixel.y(), near_m);
    if (z > 0.0f && std::abs(vertex.z() - z) < near_m) {
      classes.near_surface.push_back(i);
      classes.observed_depth.push_back(z);
    } else {
      classes.elsewhere.push_back(i);
    }
  }
}

void FindUnexplainedPoints(const PointCloud& cloud, const DepthImage& rendered, float near_m,
                           std::vector<int>& unexplained) {
  unexplained.clear();
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const float z = rendered.pixels()[static_cast<std::size_t>(cloud.pixels[i])];
    const bool explained = z > 0.0f && std::abs(cloud.points[i].z() - z) < near_m;
    if (!explained) unexplained.push_back(static_cast<int>(i));
  }
}

void PairFinder::VerticesToPoints(const std::vector<Vector3f>& vertices,
                                  const std::vector<int>& queries, const PointCloud& cloud,
                                  const KdTree& cloud_tree, float cutoff_m,
                                  std::vector<Pair>& pairs) {
  positions_.clear();
  for (const int i : queries) positions_.push_back(vertices[i]);
  cloud_tree.FindNearest(positions_, cutoff_m, neighbors_);
  for (std::size_t k = 0; k < queries.size(); ++k) {
    if (neighbors_[k].index >= 0) pairs.push_back({queries[k], cloud.points[neighbors_[k].index]});
  }
}

void PairFinder::PointsToVertices(const PointCloud& cloud, const std::vector<int>& queries,
                                  const std::vector<int>& candidates, const KdTree& candidate_tree,
                                  float cutoff_m, std::vector<Pair>& pairs) {
  positions_.clear();
  for (const int i : queries) positions_.push_back(cloud.points[i]);
  candidate_tree.FindNearest(positions_, cutoff_m, neighbors_);
  for (std::size_t k = 0; k < queries.size(); ++k) {
    if (neighbors_[k].index >= 0) pairs.push_back({candidates[neighbors_[k].index], positions_[k]});
  }
}

}  // namespace vitruvia
