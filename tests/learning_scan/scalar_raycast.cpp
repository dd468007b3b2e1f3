#include "learning_scan/scalar_raycast.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "math/rigid.h"

namespace vitruvia {
namespace {

constexpr float kCareful = 0.8f;
constexpr int kRefinements = 2;
constexpr float kBlindStep = 1.0f;
constexpr float kPastBlock = 0.01f;
constexpr int kSide = TsdfVolume::kBlockSide, kSideBits = TsdfVolume::kBlockBits;

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

struct Sample {
  float z, distance_m;
};

struct ScalarRay {
  explicit ScalarRay(const TsdfVolume& marched)
      : volume(marched), corners(marched.block_corners().begin(), marched.block_corners().end()) {}

  bool HasMemory(const TsdfVolume::Lattice& voxel) const {
    const auto corner = [&](int axis) { return voxel[axis] >> kSideBits << kSideBits; };
    return corners.contains({corner(0), corner(1), corner(2)});
  }
  bool March(const Vector3f& origin, const Vector3f& ray, const TsdfVolume::Range& range,
             Vector3f& hit) const;
  bool Refine(const Vector3f& origin, const Vector3f& ray, Sample outside, Sample inside,
              Vector3f& hit) const;
  Vector3f Gradient(const Vector3f& position) const;

  const TsdfVolume& volume;
  std::set<TsdfVolume::Lattice> corners;
};

// Walks along origin + z ray (lattice units per metre of depth) from outside to the first crossing.
bool ScalarRay::March(const Vector3f& origin, const Vector3f& ray, const TsdfVolume::Range& range,
                      Vector3f& hit) const {
  const float z_per_voxel = 1.0f / ray.norm();
  float last_z = 0.0f, last_distance = 0.0f;  // last_distance 0: none yet
  for (float z = range.near_z; z <= range.far_z;) {
    const Vector3f position = origin + z * ray;
    const TsdfVolume::Lattice voxel = {static_cast<int>(std::floor(position.x() + 0.5f)),
                                       static_cast<int>(std::floor(position.y() + 0.5f)),
                                       static_cast<int>(std::floor(position.z() + 0.5f))};
    if (!HasMemory(voxel)) {
      last_distance = 0.0f;
      z += BlockExit(position, ray, voxel) + kPastBlock * z_per_voxel;
      continue;
    }
    const TsdfVolume::Voxel cell = volume.At(voxel);
    if (cell.weight <= 0.0f) {
      last_distance = 0.0f;
      z += kBlindStep * z_per_voxel;
      continue;
    }
    float distance = cell.distance_m;
    const bool close = std::abs(distance) < 2.0f * volume.voxel_m();
    if (close && !volume.Interpolate(position, distance)) {
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
    z += std::max(kCareful * distance / volume.voxel_m(), 0.5f) * z_per_voxel;
  }
  return false;
}

// The crossing between a sample outside and one inside, by false position.
bool ScalarRay::Refine(const Vector3f& origin, const Vector3f& ray, Sample outside, Sample inside,
                       Vector3f& hit) const {
  const auto crossing = [&] {
    return outside.z +
           (inside.z - outside.z) * outside.distance_m / (outside.distance_m - inside.distance_m);
  };
  for (int i = 0; i < kRefinements; ++i) {
    Sample middle{crossing(), 0.0f};
    if (!volume.Interpolate(origin + middle.z * ray, middle.distance_m)) return false;
    (middle.distance_m > 0.0f ? outside : inside) = middle;
  }
  hit = origin + crossing() * ray;
  return true;
}

Vector3f ScalarRay::Gradient(const Vector3f& position) const {
  Vector3f gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3f step = Vector3f::Unit(axis);
    float above = 0.0f, below = 0.0f;
    if (!volume.Interpolate(position + step, above) ||
        !volume.Interpolate(position - step, below)) {
      return Vector3f::Zero();
    }
    gradient[axis] = above - below;
  }
  const float length = gradient.norm();
  return length > 0.0f ? Vector3f(gradient / length) : Vector3f::Zero();
}

}  // namespace

PointMap ScalarRaycast(const TsdfVolume& volume, const PinholeCamera& camera,
                       const Rigidd& subject_from_camera) {
  const ScalarRay marching(volume);
  PointMap map{Image<Vector3f>(camera.width, camera.height, Vector3f::Zero()),
               Image<Vector3f>(camera.width, camera.height, Vector3f::Zero())};
  const std::vector<TsdfVolume::Range> ranges =
      volume.DepthRanges(camera, Inverse(subject_from_camera));
  const int columns = (camera.width + TsdfVolume::kTile - 1) / TsdfVolume::kTile;
  const Rigidf transform = subject_from_camera.Cast<float>();
  const Vector3f origin = volume.ToLattice(transform.translation);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const TsdfVolume::Range& range =
          ranges[static_cast<std::size_t>(v / TsdfVolume::kTile) * columns + u / TsdfVolume::kTile];
      if (range.far_z <= range.near_z) continue;
      const Vector3f in_camera =
          camera.Unproject(static_cast<float>(u), static_cast<float>(v), 1.0f);
      const Vector3f ray = transform.rotation * in_camera / volume.voxel_m();
      Vector3f hit;
      if (!marching.March(origin, ray, range, hit)) continue;
      const Vector3f normal = marching.Gradient(hit);
      if (normal.dot(ray) >= 0.0f) continue;
      map.points(u, v) = volume.FromLattice(hit);
      map.normals(u, v) = normal;
    }
  }
  return map;
}

}  // namespace vitruvia
