// Nearest neighbours of query points in a set of points, by one of three methods.
#pragma once

#include <memory>
#include <vector>

#include "geometry/camera.h"
#include "search/kd_tree.h"

namespace vitruvia {

enum class Association {
  kKdTree,  // paper A: a kd-tree of the points, rebuilt whenever they change
  kWindow,  // paper B: points fall into pixel buckets; a window round the query's pixel is searched
  kExhaustive,  // brute force, eight points at a time: no structure to build
};

// Points are in the camera frame, metres, finite.
class NearestNeighbors {
 public:
  virtual ~NearestNeighbors() = default;
  virtual void Build(const std::vector<Vector3f>& points) = 0;
  // For each query its nearest point, or index -1 if none lies within max_distance_m (with kWindow:
  // and within the window). Of equally near points the one with the lowest index, except with
  // kKdTree.
  virtual void FindNearest(const std::vector<Vector3f>& queries, float max_distance_m,
                           std::vector<KdTree::Neighbor>& neighbors) const = 0;
};

// `window_px` is the window's largest half width, in pixels of the camera.
std::unique_ptr<NearestNeighbors> MakeNearestNeighbors(Association association,
                                                       const PinholeCamera& camera, int window_px);

}  // namespace vitruvia
