// Projective data association (paper B, sec. 4.1): every observed point is paired with the closest
// model vertex in a window round its pixel.
#pragma once

#include <vector>

#include "core/worker_team.h"
#include "geometry/camera.h"
#include "geometry/point_cloud.h"
#include "math/lanes.h"
#include "methods/dynamic/observations.h"
#include "methods/dynamic/surface.h"

namespace vitruvia::dynamic {

struct AssociationLimits {
  int window_px = 16;          // half width: columns and rows to either side of a point's pixel
  float cutoff_m = 0.08f;      // vertices at this distance or farther are not taken
  float facing_cosine = 0.1f;  // least cosine of the angle between normal and line of sight
};

class Association {
 public:
  Association(const PinholeCamera& camera, const SurfaceLayout& layout);

  // The pixel of each slot of a patch, −1 for one that does not face the camera or lies outside the
  // image. After PosePatch.
  void ProjectPatch(int patch, const Surface<float>& surface, const AssociationLimits& limits);
  // Sorts the vertices of all patches, once they are projected, into buckets, one for each pixel.
  // Each thread of the team fills the buckets of its share of the rows.
  void FillBuckets(const Surface<float>& surface, WorkerTeam& team);
  // For each point of the cloud the closest vertex among the buckets of its window, nearer than the
  // cutoff; of equally close ones the one of the lowest slot; −1 if there is none. The search is
  // exact: it begins at the point's pixel and stops when vertices of farther pixels cannot be
  // closer than the best one so far.
  void FindNearest(const PointCloud& cloud, const AssociationLimits& limits, WorkerTeam& team);
  // Sums the points of each vertex that was chosen, in the cloud's order. Each thread of the team
  // sums those of its share of the slots.
  void Observe(const PointCloud& cloud, WorkerTeam& team, Observations<float>& observations) const;

  const std::vector<int>& pixels() const { return pixels_; }    // per slot
  const std::vector<int>& nearest() const { return nearest_; }  // per point: a slot or −1

 private:
  // The best so far in each lane of a search.
  struct Best {
    FloatLanes squared;
    IntLanes slot;
  };
  // The visible part of a patch: number of slots with a pixel, and range of their pixels.
  struct PatchView {
    int facing = 0, lowest_pixel = 0, highest_pixel = 0;
  };
  template <class Body>
  void ForEachFacingSlot(int begin_pixel, int end_pixel, const Body& body) const;
  int CountBuckets(int begin_pixel, int end_pixel);
  void SortIntoBuckets(const Surface<float>& surface, int begin_pixel, int end_pixel,
                       int first_entry);
  void FindLongestRays(int window_px);
  int NearestTo(const Vector3f& point, int pixel, const AssociationLimits& limits) const;
  void ScanRow(const Vector3f& point, int row, int first_column, int last_column, Best& best) const;

  PinholeCamera camera_;
  const SurfaceLayout* layout_;
  std::vector<int> pixels_;
  std::vector<int> facing_;  // the slots that have a pixel, from each patch's begin on
  std::vector<PatchView> views_;
  std::vector<int> bucket_begin_;  // per pixel, and one more
  std::vector<int> part_entries_;  // per thread: the entries of the buckets that it fills
  int first_row_ = 0, last_row_ = -1;
  // The facing slots sorted by pixel: their positions and numbers, followed by kLanes dummies that
  // are never chosen.
  Columns<float> sorted_;
  std::vector<int> sorted_slots_;
  // Per column and row: the longest (u − cx, fx) or (v − cy, fy) in the window round it, pixels.
  std::vector<float> column_ray_, row_ray_;
  std::vector<int> nearest_;
};

}  // namespace vitruvia::dynamic
