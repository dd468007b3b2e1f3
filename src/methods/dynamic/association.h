// Projective data association (paper B, sec. 4.1): every observed point is paired with the closest
// model vertex in a window round its pixel.
//
// Between the iterations of a frame the surface moves little, and few points change their vertex.
// For each point a lower bound of the distance to every other vertex is kept, as Hamerly (2010)
// does for k-means. It shrinks by the largest motion of a vertex at the pixels round the point's;
// a vertex that had no pixel before counts as moved without limit. A match that is still closer
// than the bound is the closest vertex, and is not searched for. Likewise a point has no match
// while the bound of all vertices, less the largest motion in the image, is beyond the cutoff.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/worker_team.h"
#include "geometry/camera.h"
#include "geometry/point_cloud.h"
#include "math/lanes.h"
#include "methods/dynamic/observations.h"
#include "methods/dynamic/pixel_motions.h"
#include "methods/dynamic/surface.h"
#include "methods/dynamic/tile_boxes.h"

namespace vitruvia::dynamic {

struct AssociationLimits {
  int window_px = 16;          // half width: columns and rows to either side of a point's pixel
  float cutoff_m = 0.08f;      // vertices at this distance or farther are not taken
  float facing_cosine = 0.1f;  // least cosine of the angle between normal and line of sight
};

class Association {
 public:
  Association(const PinholeCamera& camera, const SurfaceLayout& layout);

  // The points that the next searches are for.
  void SetCloud(const PointCloud& cloud);
  // The pixel of each slot of a patch that faces the camera and lies inside the image. Before each
  // search once for every patch, after PosePatch. Patches may be projected on different threads.
  void ProjectPatch(int patch, const Surface<float>& surface, const AssociationLimits& limits);
  // For each point the closest vertex among those whose pixels are in its window, nearer than the
  // cutoff; of equally close ones the one of the lowest slot; −1 if there is none. Exact.
  void FindNearest(const AssociationLimits& limits, WorkerTeam& team);
  // Sums the points of each vertex that was chosen, in the cloud's order. Each thread of the team
  // sums those of its share of the slots.
  void Observe(WorkerTeam& team, Observations<float>& observations) const;

  int PixelOf(int slot) const;            // v · width + u, or −1
  std::span<const int> nearest() const {  // per point: a slot or −1
    return {nearest_.data(), static_cast<std::size_t>(point_count_)};
  }
  int searched() const { return searched_; }  // points of the last search without a proof

 private:
  struct Pixel {
    int column, row;
  };
  // The best so far in each lane of a search, and the second best.
  struct Best {
    FloatLanes squared;
    IntLanes slot;
    FloatLanes second;
  };
  struct Match {
    int slot;
    float bound_m;  // no other vertex with a pixel is closer
    float least_m;  // none at all
  };
  // The visible part of a patch: number of slots with a pixel, range of their buckets, motions.
  struct PatchView {
    int facing = 0;
    int lowest_bucket = 0, highest_bucket = 0;
    int lowest_column = 0, highest_column = 0;
    int arrived = 0;        // slots that have a pixel, but had none in the last projection
    float moved_m2 = 0.0f;  // the farthest motion of the others
  };

  // A share of the patches, sorted into buckets by one thread.
  struct Part {
    int first_patch = 0, end_patch = 0;
    std::vector<int> entries;  // per bucket: their number, then the end of those not yet written
  };
  struct PixelRows {
    int begin, end;
  };
  struct SlotRange {
    int begin, end;
  };
  static constexpr int kPointsPerRange = 256;  // a multiple of kLanes
  struct PointList {
    int count = 0;
    std::array<int, kPointsPerRange + kLanes> numbers;  // followed by room for whole lanes
  };

  int BucketOf(int row, int column) const { return row * stride_ + column; }
  PixelBox FindBox() const;
  void CollectArrivals();
  void FillBuckets(WorkerTeam& team);
  void DividePatches(int parts);
  template <class Body>
  void ForEachFacingSlot(const Part& part, const Body& body) const;
  void CountBuckets(int part);
  int CountTileRow(const PixelRows& rows) const;
  void PlaceBuckets(const PixelRows& rows, int first_entry);
  void SortIntoBuckets(Part& part);
  PixelRows RowsOfTile(int tile_row) const;
  void BoundTiles(int tile_row);
  void SetWindow(int window_px);
  int FindNearestOf(int begin, int end, float cutoff_m);
  unsigned KeepProven(int first_point, float cutoff_m);
  FloatLanes LeastDistances(int first_point, const IntLanes& is_asked, float cutoff_m) const;
  Match Search(int point, float cutoff_m) const;
  void SearchFarther(int point, float nearest_m, Best& best) const;
  void ScanRow(const Vector3f& point, int row, const ColumnRange& columns, Best& best) const;
  PointList PointsOf(int first_point, const SlotRange& slots) const;
  float SquaredDistanceOfMatch(int point) const;
  float NearestBeyond(int point, int pixels) const;
  int ReachOf(int point, float distance_m) const;

  PinholeCamera camera_;
  const SurfaceLayout* layout_;

  std::vector<int> buckets_;  // per slot; −1: without a pixel
  Columns<float> projected_;  // per slot: position at the last projection
  // The slots with a bucket, from each patch's begin on: their numbers, buckets, and motions since
  // the last projection, ∞ of those that had no pixel then.
  std::vector<int> facing_, facing_buckets_;
  std::vector<float> facing_moved_m2_;
  std::vector<int> arrived_;      // those that had none before, likewise
  std::vector<PatchView> views_;  // per patch
  TileBoxes tile_boxes_;

  // Of the whole image: positions of the slots that arrived, farthest motion of the others.
  int arrival_count_ = 0;
  Columns<float> arrivals_;
  float farthest_moved_m_ = 0.0f;

  // The facing slots, sorted by pixel: their positions and numbers, followed by dummies that
  // are never chosen. A row of buckets has one more than columns, where its last pixel ends.
  int stride_;
  PixelMotions motions_;
  PixelBox box_;  // of the slots with a bucket
  std::vector<int> bucket_begin_;
  std::vector<Part> parts_;            // one for each thread
  std::vector<int> tile_row_entries_;  // the entries of the buckets before each row of tiles
  Columns<float> sorted_;
  std::vector<int> sorted_slots_;

  // Per point, filled up to whole lanes.
  int point_count_ = 0, searched_ = 0;
  Columns<float> points_;
  std::vector<Pixel> point_pixels_;
  std::vector<int> point_buckets_;
  std::vector<int> nearest_;
  std::vector<float> bounds_m_;  // no vertex with a pixel but the nearest one is closer
  std::vector<float> least_m_;   // no vertex with a pixel is closer; 0 where not known

  // Per column and row: the longest (u − cx, fx) or (v − cy, fy) in the window round it, pixels.
  int window_px_ = -1;
  std::vector<float> column_ray_, row_ray_;
};

}  // namespace vitruvia::dynamic
