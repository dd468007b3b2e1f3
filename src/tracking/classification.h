// Paper A's classification of visible vertices and observed points, and the correspondences that
// follow from it.
#pragma once

#include <vector>

#include "geometry/point_cloud.h"
#include "search/nearest_neighbors.h"

namespace vitruvia {

// Class of a vertex that lies behind the captured surface.
enum class BehindSurface {
  kElsewhere,  // paper: it is V2 and is paired with a point
  kHidden,     // another part of the body may hide it, so it is neither V1 nor V2
};

// Thresholds of nearness.
struct NearnessSettings {
  float depth_m;  // along z, at the same pixel
  // At silhouettes, depth jumps between body and background within half a pixel. A vertex or point
  // that is near in depth to a pixel within this many columns and rows counts as explained,
  // although it is not in V1.
  int edge_px;
  float smooth_m;  // see SampleDepth
  BehindSurface behind = BehindSurface::kElsewhere;
};

// V1: visible vertices near the captured surface at their pixel. V2: visible vertices that no
// captured pixel explains.
struct VertexClasses {
  std::vector<int> near_surface;      // V1: vertex indices
  std::vector<float> observed_depth;  // V1: the captured depth at each one's pixel, metres
  std::vector<float> weight;          // V1: of each one's observation; 1 unless pixels are shared
  std::vector<int> elsewhere;         // V2: vertex indices
};
void ClassifyVertices(const std::vector<Vector3f>& vertices, const std::vector<int>& visible,
                      const DepthImage& captured, const PinholeCamera& camera,
                      const NearnessSettings& nearness, VertexClasses& classes);

// Replaces the observed depth of each vertex of V1 by the vertex's depth plus the mean, over the
// pixels within `window_px` columns and rows of it, of captured minus rendered depth. Pixels whose
// depths differ by `nearness_m` or more do not count. `rendered` must show the vertices in the
// same pose.
void AverageObservedDepth(const std::vector<Vector3f>& vertices, const DepthImage& captured,
                          const DepthImage& rendered, const PinholeCamera& camera, int window_px,
                          float nearness_m, VertexClasses& classes);

// Shares the weight of a pixel among the vertices of V1 that read it.
//
// A mesh is dense in the head, the hands and the feet, where several vertices read one pixel. If
// each counts in full, the noise of that pixel counts as often, and terms that hold a bone against
// noise lose by the same factor. Not in the paper.
class PixelSharing {
 public:
  explicit PixelSharing(const PinholeCamera& camera);

  // The weight of each of n vertices in a pixel becomes 1 − extent + extent / n: 1 for an extent of
  // 0; for an extent of 1, the weights of a pixel sum up to 1.
  void Weigh(const std::vector<Vector3f>& vertices, float extent, VertexClasses& classes);

 private:
  PinholeCamera camera_;
  std::vector<int> readers_;  // per pixel, and one for vertices outside; all 0 between calls
  std::vector<int> pixels_;   // of each vertex of V1
};

// P2: indices of the cloud's points that the rendered model does not explain.
void FindUnexplainedPoints(const PointCloud& cloud, const DepthImage& rendered,
                           const NearnessSettings& nearness, std::vector<int>& unexplained);

// A model vertex and the observed point it should move to.
struct Pair {
  int vertex = -1;
  Vector3f target = Vector3f::Zero();  // camera frame, metres
};

// Appends for each query vertex its closest point of the cloud, where one lies within cutoff_m.
class PairFinder {
 public:
  // `near_cloud` holds cloud.points.
  void VerticesToPoints(const std::vector<Vector3f>& vertices, const std::vector<int>& queries,
                        const PointCloud& cloud, const NearestNeighbors& near_cloud, float cutoff_m,
                        std::vector<Pair>& pairs);
  // Removes from `queries` the cloud's points within distance_m of what `near` holds.
  void DropNear(const PointCloud& cloud, const NearestNeighbors& near, float distance_m,
                std::vector<int>& queries);
  // Appends for each query point its closest vertex among `candidates`, whose positions
  // `near_candidates` holds, where one lies within that vertex's cutoff. `cutoff_m(vertex)` is at
  // most largest_cutoff_m.
  template <class Cutoff>
  void PointsToVertices(const PointCloud& cloud, const std::vector<int>& queries,
                        const std::vector<int>& candidates, const NearestNeighbors& near_candidates,
                        float largest_cutoff_m, Cutoff cutoff_m, std::vector<Pair>& pairs) {
    FindNearest(cloud.points, queries, near_candidates, largest_cutoff_m);
    for (std::size_t k = 0; k < queries.size(); ++k) {
      if (neighbors_[k].index < 0) continue;
      const int vertex = candidates[neighbors_[k].index];
      const float cutoff = cutoff_m(vertex);
      if (neighbors_[k].squared_distance <= cutoff * cutoff) {
        pairs.push_back({vertex, positions_[k]});
      }
    }
  }

 private:
  void FindNearest(const std::vector<Vector3f>& points, const std::vector<int>& queries,
                   const NearestNeighbors& near, float cutoff_m);

  std::vector<Vector3f> positions_;  // kept between frames to avoid allocation
  std::vector<KdTree::Neighbor> neighbors_;
};

}  // namespace vitruvia
