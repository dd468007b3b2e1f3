// Points sorted by the pixel that they project to, so that neighbours are sought only nearby in the
// image.
#pragma once

#include <vector>

#include "geometry/camera.h"
#include "search/kd_tree.h"

namespace vitruvia {

class PixelGrid {
 public:
  explicit PixelGrid(const PinholeCamera& camera);

  // Points (camera frame, metres) out of view are never found.
  void Build(const std::vector<Vector3f>& points);

  // The nearest point to each query (camera frame) within max_distance_m, among those in the square
  // cells of kCellPx pixels that lie within window_px columns and rows of the query's own cell, or
  // within max_distance_m if that is fewer cells; of equally near points the first. A query out of
  // view has no neighbour.
  void FindNearest(const std::vector<Vector3f>& queries, float max_distance_m, int window_px,
                   std::vector<KdTree::Neighbor>& neighbors) const;

  static constexpr int kCellPx = 4;

 private:
  struct Entry {
    Vector3f point;
    std::int32_t index;
  };

  int CellOf(const Vector3f& point) const;
  KdTree::Neighbor Nearest(const Vector3f& query, float max_distance_m, int window_px) const;

  PinholeCamera camera_;
  int columns_, rows_;
  std::vector<int> first_;    // entry at which each cell begins
  std::vector<int> cell_of_;  // of each point, -1: out of view
  std::vector<Entry> sorted_;
};

}  // namespace vitruvia
