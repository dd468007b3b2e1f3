// The volume's surface seen by a camera.
#include <algorithm>
#include <cmath>
#include <limits>

#include "learning/scan/tsdf_volume.h"
#include "math/rigid.h"

namespace vitruvia {
namespace {

constexpr int kTile = 8;             // pixels
constexpr float kNearM = 0.05f;      // nothing is looked for nearer to the camera
constexpr float kCareful = 0.8f;     // of a distance is stepped: it is measured only approximately
constexpr int kRefinements = 2;      // of a crossing, by false position
constexpr float kBlindStep = 1.0f;   // voxels, where a block has not been observed
constexpr float kPastBlock = 0.01f;  // voxels beyond a block's end: surely in the next one
constexpr int kSide = TsdfVolume::kBlockSide, kSideBits = TsdfVolume::kBlockBits;

}  // namespace

// Depths (along z) between which a tile's rays may meet the surface; far < near: they meet none.
struct TsdfVolume::Range {
  float near_z = std::numeric_limits<float>::infinity();
  float far_z = 0.0f;
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

// How far along a ray (in its own units) the block round a voxel ends.
float BlockExit(const Vector3f& position, const Vector3f& ray, const std::array<int, 3>& voxel) {
  float exit = std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (ray[axis] == 0.0f) continue;
    const int first = (voxel[axis] >> kSideBits) << kSideBits;
    const float plane = static_cast<float>(ray[axis] > 0.0f ? first + kSide : first) - 0.5f;
    exit = std::min(exit, (plane - position[axis]) / ray[axis]);
  }
  return std::max(exit, 0.0f);
}

}  // namespace

// Walks along origin + z ray (lattice units per metre of depth) from outside to the first crossing.
bool TsdfVolume::March(const Vector3f& origin, const Vector3f& ray, const Range& range,
                       Vector3f& hit) const {
  const float z_per_voxel = 1.0f / ray.norm();
  float last_z = 0.0f, last_distance = 0.0f;  // last_distance 0: none yet
  for (float z = range.near_z; z <= range.far_z;) {
    const Vector3f position = origin + z * ray;
    const Lattice voxel = {static_cast<int>(std::floor(position.x() + 0.5f)),
                           static_cast<int>(std::floor(position.y() + 0.5f)),
                           static_cast<int>(std::floor(position.z() + 0.5f))};
    const std::int64_t index = IndexOf(voxel[0], voxel[1], voxel[2]);
    if (index < 0) {
      last_distance = 0.0f;
      z += BlockExit(position, ray, voxel) + kPastBlock * z_per_voxel;
      continue;
    }
    if (cells_[index].weight <= 0.0f) {
      last_distance = 0.0f;
      z += kBlindStep * z_per_voxel;
      continue;
    }
    float distance = cells_[index].distance * truncation_m_;
    const bool close = std::abs(distance) < 2.0f * voxel_m_;
    if (close && !Interpolate(position, distance)) {
      last_distance = 0.0f;
      z += kBlindStep * z_per_voxel;
      continue;
    }
    if (distance <= 0.0f) {
      return last_distance > 0.0f &&  // or it comes from behind
             Refine(origin, ray, {last_z, last_distance}, {z, distance}, hit);
    }
    last_z = z;
    last_distance = distance;
    z += std::max(kCareful * distance / voxel_m_, 0.5f) * z_per_voxel;
  }
  return false;
}

// The crossing between a sample outside and one inside, by false position.
bool TsdfVolume::Refine(const Vector3f& origin, const Vector3f& ray, Sample outside, Sample inside,
                        Vector3f& hit) const {
  const auto crossing = [&] {
    return outside.z +
           (inside.z - outside.z) * outside.distance_m / (outside.distance_m - inside.distance_m);
  };
  for (int i = 0; i < kRefinements; ++i) {
    Sample middle{crossing(), 0.0f};
    if (!Interpolate(origin + middle.z * ray, middle.distance_m)) return false;
    (middle.distance_m > 0.0f ? outside : inside) = middle;
  }
  hit = origin + crossing() * ray;
  return true;
}

Vector3f TsdfVolume::Gradient(const Vector3f& position) const {
  Vector3f gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3f step = Vector3f::Unit(axis);
    float above = 0.0f, below = 0.0f;
    if (!Interpolate(position + step, above) || !Interpolate(position - step, below)) {
      return Vector3f::Zero();
    }
    gradient[axis] = above - below;
  }
  const float length = gradient.norm();
  return length > 0.0f ? Vector3f(gradient / length) : Vector3f::Zero();
}

PointMap TsdfVolume::Raycast(const PinholeCamera& camera, const Rigidd& subject_from_camera,
                             WorkerTeam& team) const {
  PointMap map{Image<Vector3f>(camera.width, camera.height, Vector3f::Zero()),
               Image<Vector3f>(camera.width, camera.height, Vector3f::Zero())};
  const std::vector<Range> ranges = DepthRanges(camera, Inverse(subject_from_camera));
  const int columns = (camera.width + kTile - 1) / kTile;
  const Rigidf transform = subject_from_camera.Cast<float>();
  const Vector3f origin = ToLattice(transform.translation);
  team.For(camera.height, [&](int begin, int end) {
    for (int v = begin; v < end; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const Range& range = ranges[static_cast<std::size_t>(v / kTile) * columns + u / kTile];
        if (range.far_z <= range.near_z) continue;
        const Vector3f in_camera =
            camera.Unproject(static_cast<float>(u), static_cast<float>(v), 1.0f);
        const Vector3f ray = transform.rotation * in_camera / voxel_m_;
        Vector3f hit;
        if (!March(origin, ray, range, hit)) continue;
        const Vector3f normal = Gradient(hit);
        if (normal.dot(ray) >= 0.0f) continue;
        map.points(u, v) = FromLattice(hit);
        map.normals(u, v) = normal;
      }
    }
  });
  return map;
}

}  // namespace vitruvia
