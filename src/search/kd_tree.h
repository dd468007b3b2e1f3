// Nearest neighbours in a 3-D point set (FLANN single kd-tree, exact).
#pragma once

#include <memory>
#include <vector>

#include "geometry/mesh.h"

namespace vitruvia {

class KdTree {
 public:
  KdTree();
  ~KdTree();
  KdTree(KdTree&&) noexcept;
  KdTree& operator=(KdTree&&) noexcept;

  // Points must be finite. An empty set is allowed: queries then find nothing.
  void Build(const std::vector<Vector3f>& points);

  struct Neighbor {
    int index = -1;  // -1: none
    float squared_distance = 0.0f;
  };
  // For each query its nearest point, or index -1 where none lies within max_distance (metres).
  void FindNearest(const std::vector<Vector3f>& queries, float max_distance,
                   std::vector<Neighbor>& neighbors) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace vitruvia
