// Paper A's sorting of the visible model and the observed points, and the pairs that follow from
// it.
#pragma once

#include <vector>

#include "geometry/kd_tree.h"
#include "matching/point_cloud.h"

namespace vitruvia {

// How near is near.
struct NearnessSettings {
  float depth_m;  // along z, at the same pixel
  // Depth jumps at silhouettes, where half a pixel decides between the body and what is behind it.
  // What is near within this many columns and rows counts as explained, though it is no V1.
  int edge_px;
  float smooth_m;  // see SampleDepth
};

// V1: visible vertices near the captured surface at their pixel. V2: visible vertices that no
// captured pixel explains.
struct VertexClasses {
  std::vector<int> near_surface;      // V1: vertex indices
  std::vector<float> observed_depth;  // V1: the captured depth at each one's pixel, metres
  std::vector<int> elsewhere;         // V2: vertex indices
};
void ClassifyVertices(const std::vector<Vector3f>& vertices, const std::vector<int>& visible,
                      const DepthImage& captured, const PinholeCamera& camera,
                      const NearnessSettings& nearness, VertexClasses& classes);

// P2: indices of the cloud's points that the rendered model does not explain.
void FindUnexplainedPoints(const PointCloud& cloud, const DepthImage& rendered,
                           const NearnessSettings& nearness, std::vector<int>& unexplained);

// A model vertex and the observed point it should move to.
struct Pair {
  int vertex = -1;
  Vector3f target = Vector3f::Zero();  // camera frame, metres
};

// Appends for each query vertex its closest point of the cloud, where one lies within cutoff_m.
// `cloud_tree` holds cloud.points.
class PairFinder {
 public:
  void VerticesToPoints(const std::vector<Vector3f>& vertices, const std::vector<int>& queries,
                        const PointCloud& cloud, const KdTree& cloud_tree, float cutoff_m,
                        std::vector<Pair>& pairs);
  // Appends for each query point its closest vertex among `candidates`, whose positions
  // `candidate_tree` holds, where one lies within cutoff_m.
  void PointsToVertices(const PointCloud& cloud, const std::vector<int>& queries,
                        const std::vector<int>& candidates, const KdTree& candidate_tree,
                        float cutoff_m, std::vector<Pair>& pairs);

 private:
  std::vector<Vector3f> positions_;  // kept between frames to avoid allocation
  std::vector<KdTree::Neighbor> neighbors_;
};

}  // namespace vitruvia
