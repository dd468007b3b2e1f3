// A truncated signed distance function, the average of many depth frames (Curless & Levoy 1996).
//
// A voxel is a sample at a lattice point. Memory is allocated, in contiguous arrays, only for
// blocks of 8×8×8 voxels near an observed surface; a dense grid of block numbers indexes them.
//
// Distances are positive outside the body, negative inside. Departure from KF: a frame's distance
// is measured across the surface (the depth difference times the ray's component along the pixel's
// normal) and not along the ray, so that views from different sides agree away from the surface.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/worker_team.h"
#include "geometry/camera.h"
#include "learning/scan/point_map.h"
#include "learning/scan/settings.h"
#include "math/lanes.h"

namespace vitruvia {

class TsdfVolume {
 public:
  static constexpr int kBlockBits = 3, kBlockSide = 1 << kBlockBits;
  static constexpr int kBlockVoxels = kBlockSide * kBlockSide * kBlockSide;
  using Lattice = std::array<int, 3>;

  explicit TsdfVolume(const VolumeSettings& settings);

  // Averages a frame into the volume. `seen` holds the frame's points (camera frame) and normals;
  // pixels without a normal are left out. RunError if the observed surface needs more blocks than a
  // body can.
  void Integrate(const DepthImage& depth, const PointMap& seen, const PinholeCamera& camera,
                 const Rigidd& subject_from_camera, WorkerTeam& team);

  // The surface as a camera sees it: points and normals in the subject frame. Pixels whose ray
  // leaves the observed space, or meets the surface from behind, have none.
  PointMap Raycast(const PinholeCamera& camera, const Rigidd& subject_from_camera,
                   WorkerTeam& team) const;

  // Averaged distance in metres (within ± truncation) and weight at a lattice point; weight 0 where
  // nothing was observed.
  struct Voxel {
    float distance_m = 0.0f;
    float weight = 0.0f;
  };
  Voxel At(const Lattice& point) const;

  // Trilinear distance in metres; false if one of the eight voxels round `position` (lattice units)
  // is unobserved.
  bool Interpolate(const Vector3f& position, float& distance_m) const;

  // Depths (along z) between which rays may meet the surface; far < near: they meet none.
  struct Range {
    float near_z = std::numeric_limits<float>::infinity();
    float far_z = 0.0f;
  };
  static constexpr int kTile = 8;  // pixels
  // Of each tile of an image, row by row.
  std::vector<Range> DepthRanges(const PinholeCamera& camera,
                                 const Rigidd& camera_from_subject) const;

  int block_count() const { return static_cast<int>(block_corners_.size()); }
  // The lowest lattice point of each block with memory.
  const std::vector<Lattice>& block_corners() const { return block_corners_; }
  Vector3f ToLattice(const Vector3f& point_in_subject) const {
    return (point_in_subject - low_) / voxel_m_;
  }
  Vector3f FromLattice(const Vector3f& position) const { return low_ + voxel_m_ * position; }
  float voxel_m() const { return voxel_m_; }

 private:
  struct View;  // a frame being integrated
  struct VoxelLanes;
  struct SampleLanes;

  // Index into cells_; -1: not allocated.
  std::int64_t IndexOf(int x, int y, int z) const {
    const int bx = x >> kBlockBits, by = y >> kBlockBits, bz = z >> kBlockBits;
    if (bx < 0 || by < 0 || bz < 0 || bx >= blocks_[0] || by >= blocks_[1] || bz >= blocks_[2]) {
      return -1;
    }
    const std::int64_t block =
        block_numbers_[(static_cast<std::size_t>(bz) * blocks_[1] + by) * blocks_[0] + bx];
    if (block < 0) return -1;
    constexpr int kMask = kBlockSide - 1;
    return block * kBlockVoxels + ((((z & kMask) << kBlockBits) + (y & kMask)) << kBlockBits) +
           (x & kMask);
  }
  void MakeRoom(const PointMap& seen, const Rigidd& subject_from_camera);
  void MakeBlock(const Vector3f& point_in_subject);
  void IntegrateBlock(int block, const View& view);
  // The same for eight voxels, where they are wanted.
  IntLanes IndicesOf(const IntLanes& x, const IntLanes& y, const IntLanes& z,
                     const IntLanes& wanted) const;
  VoxelLanes CellsAt(const IntLanes& index) const;
  IntLanes Interpolate(const PointLanes& position, const IntLanes& wanted,
                       FloatLanes& distance_m) const;
  IntLanes March(const Vector3f& origin, const PointLanes& ray, const Range& range,
                 PointLanes& hit_in_lattice) const;
  IntLanes Refine(const Vector3f& origin, const PointLanes& ray, SampleLanes outside,
                  SampleLanes inside, IntLanes crossed, PointLanes& hit_in_lattice) const;
  IntLanes Gradient(const PointLanes& position, IntLanes wanted, PointLanes& gradient) const;

  VolumeSettings settings_;
  float voxel_m_, truncation_m_;
  Vector3f low_;
  std::array<int, 3> blocks_;                // of the dense grid
  std::vector<std::int32_t> block_numbers_;  // dense; -1: not allocated
  std::vector<Lattice> block_corners_;
  struct Cell {
    float distance = 1.0f;  // in units of the truncation
    float weight = 0.0f;
  };
  std::vector<Cell> cells_;  // blocks × 512
};

}  // namespace vitruvia
