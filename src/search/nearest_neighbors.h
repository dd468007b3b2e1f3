// Which of a set of points lies nearest to each of some others: three ways to find out.
#pragma once

#include <memory>
#include <vector>

#include "geometry/camera.h"
#include "search/kd_tree.h"

namespace vitruvia {

enum class Association {
  kKdTree,  // paper A: a tree of the points, built anew whenever they change
  kWindow,  // paper B: points fall into pixel buckets; a window round the query's pixel is searched
  kExhaustive,  // every point is looked at, eight at a time: no structure to build
};

// Points are in the camera frame, metres, finite.
class NearestNeighbors {
 public:
  virtual ~NearestNeighbors() = default;
  virtual void Build(const std::vector<Vector3f>& points) = 0;
  // For each query its nearest point, or index -1 where none lies within max_distance_m (or, for a
  // window, within it). Among points of one distance the one with the lowest index, except in a
  // tree.
  virtual void FindNearest(const std::vector<Vector3f>& queries, float max_distance_m,
                           std::vector<KdTree::Neighbor>& neighbors) const = 0;
};

// `window_px` is the window's largest half width, in pixels of the camera.
std::unique_ptr<NearestNeighbors> MakeNearestNeighbors(Association association,
                                                       const PinholeCamera& camera, int window_px);

}  // namespace vitruvia
