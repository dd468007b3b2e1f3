// The volume's surface seen by a camera.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "learning/scan/gathered.h"
#include "learning/scan/tsdf_volume.h"
#include "math/rigid.h"

namespace vitruvia {
namespace {

constexpr float kNearM = 0.05f;      // nothing is looked for nearer to the camera
constexpr float kCareful = 0.8f;     // of a distance is stepped: it is measured only approximately
constexpr int kRefinements = 2;      // of a crossing, by false position
constexpr float kBlindStep = 1.0f;   // voxels, where a block has not been observed
constexpr float kPastBlock = 0.01f;  // voxels beyond a block's end: surely in the next one
constexpr int kSide = TsdfVolume::kBlockSide, kSideBits = TsdfVolume::kBlockBits;

}  // namespace

struct TsdfVolume::VoxelLanes {
  FloatLanes distance, weight;  // weight 0: not allocated
};

struct TsdfVolume::SampleLanes {  // on rays
  FloatLanes z, distance_m;

  friend SampleLanes Selected(const IntLanes& mask, const SampleLanes& a, const SampleLanes& b) {
    return {mask ? a.z : b.z, mask ? a.distance_m : b.distance_m};
  }
};

std::vector<TsdfVolume::Range> TsdfVolume::DepthRanges(const PinholeCamera& camera,
                                                       const Rigidd& camera_from_subject) const {
  const int columns = (camera.width + kTile - 1) / kTile,
            rows = (camera.height + kTile - 1) / kTile;
  std::vector<Range> ranges(static_cast<std::size_t>(columns) * rows);
  const Rigidf transform = camera_from_subject.Cast<float>();
  const float half = 0.5f * kSide * voxel_m_, radius = std::sqrt(3.0f) * half;
  for (const Lattice& corner : block_corners_) {
    const Vector3f low = FromLattice({static_cast<float>(corner[0]), static_cast<float>(corner[1]),
                                      static_cast<float>(corner[2])});
    const Vector3f middle = transform * (low + Vector3f::Constant(half));
    const float near_z = std::max(middle.z() - radius, kNearM), far_z = middle.z() + radius;
    if (far_z <= kNearM) continue;
    // The ball's bounding box, projected at its near side.
    const auto tile = [](double at, int limit) {
      return static_cast<int>(std::clamp(std::floor(at / kTile), 0.0, limit - 1.0));
    };
    const auto u_of = [&](float x) { return camera.cx + camera.fx * x / near_z; };
    const auto u_far = [&](float x) { return camera.cx + camera.fx * x / far_z; };
    const auto v_of = [&](float y) { return camera.cy + camera.fy * y / near_z; };
    const auto v_far = [&](float y) { return camera.cy + camera.fy * y / far_z; };
    const float left = middle.x() - radius, right = middle.x() + radius;
    const float top = middle.y() - radius, bottom = middle.y() + radius;
    const double u_min = std::min(u_of(left), u_far(left)) - 1.0;
    const double u_max = std::max(u_of(right), u_far(right)) + 1.0;
    const double v_min = std::min(v_of(top), v_far(top)) - 1.0;
    const double v_max = std::max(v_of(bottom), v_far(bottom)) + 1.0;
    if (u_max < 0.0 || v_max < 0.0 || u_min > camera.width || v_min > camera.height) continue;
    for (int tv = tile(v_min, rows); tv <= tile(v_max, rows); ++tv) {
      for (int tu = tile(u_min, columns); tu <= tile(u_max, columns); ++tu) {
        Range& range = ranges[static_cast<std::size_t>(tv) * columns + tu];
        range.near_z = std::min(range.near_z, near_z);
        range.far_z = std::max(range.far_z, far_z);
      }
    }
  }
  return ranges;
}

namespace {

PointLanes Along(const Vector3f& origin, const FloatLanes& z, const PointLanes& ray) {
  return {origin.x() + z * ray.x, origin.y() + z * ray.y, origin.z() + z * ray.z};
}

// In the order in which Eigen adds.
FloatLanes Dot(const PointLanes& a, const PointLanes& b) {
  return a.x * b.x + (a.y * b.y + a.z * b.z);
}

// How far along a ray (in its own units) the block round a voxel ends, on one axis.
FloatLanes AxisExit(const FloatLanes& position, const FloatLanes& ray, const IntLanes& voxel) {
  constexpr FloatLanes kNever = FloatLanes{} + std::numeric_limits<float>::infinity();
  const IntLanes first = (voxel >> kSideBits) << kSideBits;
  const IntLanes ahead = ray > 0.0f ? first + kSide : first;
  const FloatLanes plane = __builtin_convertvector(ahead, FloatLanes) - 0.5f;
  return ray == 0.0f ? kNever : (plane - position) / ray;
}

// How far along a ray the block round a voxel ends.
FloatLanes BlockExit(const PointLanes& position, const PointLanes& ray, const IntLanes& x,
                     const IntLanes& y, const IntLanes& z) {
  const FloatLanes exit = Min(Min(AxisExit(position.x, ray.x, x), AxisExit(position.y, ray.y, y)),
                              AxisExit(position.z, ray.z, z));
  return Max(exit, FloatLanes{});
}

}  // namespace

IntLanes TsdfVolume::IndicesOf(const IntLanes& x, const IntLanes& y, const IntLanes& z,
                               const IntLanes& wanted) const {
  const IntLanes bx = x >> kBlockBits, by = y >> kBlockBits, bz = z >> kBlockBits;
  const IntLanes inside = wanted & (bx >= 0) & (by >= 0) & (bz >= 0) & (bx < blocks_[0]) &
                          (by < blocks_[1]) & (bz < blocks_[2]);
  const IntLanes place = (bz * blocks_[1] + by) * blocks_[0] + bx;
  const IntLanes block = Gathered(block_numbers_.data(), inside ? place : IntLanes{});
  constexpr int kMask = kBlockSide - 1;
  const IntLanes index = block * kBlockVoxels +
                         ((((z & kMask) << kBlockBits) + (y & kMask)) << kBlockBits) + (x & kMask);
  return inside & (block >= 0) ? index : IntLanes{} - 1;
}

TsdfVolume::VoxelLanes TsdfVolume::CellsAt(const IntLanes& index) const {
  static_assert(sizeof(Cell) == 2 * sizeof(float));
  const auto* cells = reinterpret_cast<const float*>(cells_.data());
  const auto [distance, weight] = GatheredPairs(cells, index < 0 ? IntLanes{} : index);
  return {distance, index < 0 ? FloatLanes{} : weight};
}

// As for one position, for those lanes that are wanted. Returns those that have a distance.
IntLanes TsdfVolume::Interpolate(const PointLanes& position, const IntLanes& wanted,
                                 FloatLanes& distance_m) const {
  const FloatLanes x = Floor(position.x), y = Floor(position.y), z = Floor(position.z);
  IntLanes known = wanted & (x >= 0.0f) & (y >= 0.0f) & (z >= 0.0f);
  const IntLanes i = Truncate(known ? x : FloatLanes{}), j = Truncate(known ? y : FloatLanes{}),
                 k = Truncate(known ? z : FloatLanes{});
  constexpr int kMask = kBlockSide - 1;
  const IntLanes at_end = ((i & kMask) == kMask) | ((j & kMask) == kMask) | ((k & kMask) == kMask);
  const bool in_one_block = Bits(at_end & known) == 0;
  const IntLanes first = IndicesOf(i, j, k, known);
  std::array<FloatLanes, 8> corners;
  for (int c = 0; c < 8; ++c) {
    const int right = c & 1, up = (c >> 1) & 1, ahead = c >> 2;
    const IntLanes index =
        in_one_block
            ? (first < 0 ? first
                         : first + (right + kBlockSide * up + kBlockSide * kBlockSide * ahead))
            : IndicesOf(i + right, j + up, k + ahead, known);
    const VoxelLanes cells = CellsAt(index);
    known &= cells.weight > 0.0f;
    if (Bits(known) == 0) return known;
    corners[c] = cells.distance;
  }
  const FloatLanes fx = position.x - x, fy = position.y - y, fz = position.z - z;
  for (int c = 0; c < 8; c += 2) corners[c] += fx * (corners[c + 1] - corners[c]);
  for (int c = 0; c < 8; c += 4) corners[c] += fy * (corners[c + 2] - corners[c]);
  distance_m = (corners[0] + fz * (corners[4] - corners[0])) * truncation_m_;
  return known;
}

// Walks along origin + z ray (lattice units per metre of depth) from outside to the first crossing,
// eight rays side by side: a ray waits for memory most of the time.
IntLanes TsdfVolume::March(const Vector3f& origin, const PointLanes& ray, const Range& range,
                           PointLanes& hit) const {
  const FloatLanes z_per_voxel = 1.0f / Sqrt(Dot(ray, ray));
  FloatLanes z = FloatLanes{} + range.near_z;
  SampleLanes last{};  // distance 0: none yet
  SampleLanes outside{}, inside{};
  IntLanes crossed{}, walking = z <= range.far_z;
  while (Bits(walking) != 0) {
    const PointLanes position = Along(origin, z, ray);
    const IntLanes x = Truncate(Floor(position.x + 0.5f)), y = Truncate(Floor(position.y + 0.5f)),
                   k = Truncate(Floor(position.z + 0.5f));
    const IntLanes index = IndicesOf(x, y, k, walking);
    const VoxelLanes cells = CellsAt(index);
    FloatLanes distance = cells.distance * truncation_m_;
    IntLanes seen = cells.weight > 0.0f;
    const IntLanes close = seen & (Abs(distance) < 2.0f * voxel_m_);
    if (Bits(close) != 0) {
      FloatLanes between{};
      const IntLanes known = Interpolate(position, close, between);
      distance = known ? between : distance;
      seen &= ~(close & ~known);
    }
    const IntLanes behind = seen & (distance <= 0.0f);
    const IntLanes met = behind & (last.distance_m > 0.0f);  // or it comes from behind
    outside = Selected(met, last, outside);
    inside = Selected(met, {z, distance}, inside);
    crossed |= met;
    last = {seen ? z : last.z, seen ? distance : FloatLanes{}};
    const FloatLanes step = Max(kCareful * distance / voxel_m_, FloatLanes{} + 0.5f) * z_per_voxel;
    const FloatLanes blind = kBlindStep * z_per_voxel;
    FloatLanes ahead = seen ? step : blind;
    const IntLanes without_memory = walking & (index < 0);
    if (Bits(without_memory) != 0) {
      const FloatLanes exit = BlockExit(position, ray, x, y, k) + kPastBlock * z_per_voxel;
      ahead = without_memory ? exit : ahead;
    }
    walking &= ~behind;
    z = walking ? z + ahead : z;
    walking &= z <= range.far_z;
  }
  return Refine(origin, ray, outside, inside, crossed, hit);
}

// The crossings between samples outside and inside, by false position.
IntLanes TsdfVolume::Refine(const Vector3f& origin, const PointLanes& ray, SampleLanes outside,
                            SampleLanes inside, IntLanes crossed, PointLanes& hit) const {
  const auto crossing = [&] {
    return outside.z +
           (inside.z - outside.z) * outside.distance_m / (outside.distance_m - inside.distance_m);
  };
  for (int i = 0; i < kRefinements && Bits(crossed) != 0; ++i) {
    SampleLanes middle{crossing(), {}};
    crossed = Interpolate(Along(origin, middle.z, ray), crossed, middle.distance_m);
    const IntLanes still_outside = middle.distance_m > 0.0f;
    outside = Selected(still_outside, middle, outside);
    inside = Selected(still_outside, inside, middle);
  }
  hit = Along(origin, crossing(), ray);
  return crossed;
}

// Of unit length, where there is one. Returns the lanes that have one.
IntLanes TsdfVolume::Gradient(const PointLanes& position, IntLanes wanted,
                              PointLanes& gradient) const {
  const auto along = [&](FloatLanes PointLanes::*axis) {
    PointLanes above = position, below = position;
    above.*axis += 1.0f;
    below.*axis -= 1.0f;
    FloatLanes distance_above{}, distance_below{};
    wanted = Interpolate(above, wanted, distance_above);
    wanted = Interpolate(below, wanted, distance_below);
    return distance_above - distance_below;
  };
  gradient.x = along(&PointLanes::x);
  gradient.y = along(&PointLanes::y);
  gradient.z = along(&PointLanes::z);
  const FloatLanes length = Sqrt(Dot(gradient, gradient));
  gradient = {gradient.x / length, gradient.y / length, gradient.z / length};
  return wanted & (length > 0.0f);
}

PointMap TsdfVolume::Raycast(const PinholeCamera& camera, const Rigidd& subject_from_camera,
                             WorkerTeam& team) const {
  PointMap map{Image<Vector3f>(camera.width, camera.height, Vector3f::Zero()),
               Image<Vector3f>(camera.width, camera.height, Vector3f::Zero())};
  const std::vector<Range> ranges = DepthRanges(camera, Inverse(subject_from_camera));
  const int columns = (camera.width + kTile - 1) / kTile;
  const Rigidf transform = subject_from_camera.Cast<float>();
  const Vector3f origin = ToLattice(transform.translation);
  static_assert(kTile == kLanes);
  team.For(camera.height, [&](int begin, int end) {
    for (int v = begin; v < end; ++v) {
      for (int column = 0; column < columns; ++column) {
        const Range& range = ranges[static_cast<std::size_t>(v / kTile) * columns + column];
        if (range.far_z <= range.near_z) continue;
        std::array<Vector3f, kLanes> rays;
        for (int lane = 0; lane < kLanes; ++lane) {
          const Vector3f in_camera = camera.Unproject(static_cast<float>(column * kTile + lane),
                                                      static_cast<float>(v), 1.0f);
          rays[lane] = transform.rotation * in_camera / voxel_m_;
        }
        const PointLanes ray = LoadPoints(rays.front().data());
        PointLanes hit, normal;
        IntLanes met = March(origin, ray, range, hit);
        met &= Gradient(hit, met, normal);
        met &= ~(Dot(normal, ray) >= 0.0f);
        unsigned lanes = Bits(met & (CountFrom(column * kTile) < camera.width));
        for (; lanes != 0; lanes &= lanes - 1) {
          const int lane = std::countr_zero(lanes), u = column * kTile + lane;
          map.points(u, v) = FromLattice({hit.x[lane], hit.y[lane], hit.z[lane]});
          map.normals(u, v) = {normal.x[lane], normal.y[lane], normal.z[lane]};
        }
      }
    }
  });
  return map;
}

}  // namespace vitruvia
