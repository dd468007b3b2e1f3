#include "learning/scan/tsdf_volume.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"

namespace vitruvia {
namespace {

constexpr int kMaxBlocks = 200000;  // 100 million voxels: ten times what a body needs at 3 mm
// Behind the surface a voxel's weight falls to nothing, so that the far side of a hand is not taken
// for its near side's inside; up to this share of the truncation it does not, as noise would
// otherwise count more on one side of the surface than on the other.
constexpr float kFullWeightBehind = 0.5f;

constexpr int kSide = TsdfVolume::kBlockSide;

}  // namespace

TsdfVolume::TsdfVolume(const VolumeSettings& settings)
    : settings_(settings),
      voxel_m_(static_cast<float>(settings.voxel_m)),
      truncation_m_(static_cast<float>(settings.truncation_m)),
      low_(Vector3d(settings.low_m[0], settings.low_m[1], settings.low_m[2]).cast<float>()) {
  const std::string problem = settings.Problem();
  Require(problem.empty(), "TsdfVolume: {}", problem);
  std::size_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double extent_m = settings.high_m[axis] - settings.low_m[axis];
    blocks_[axis] = static_cast<int>(std::ceil(extent_m / (settings.voxel_m * kSide)));
    count *= static_cast<std::size_t>(blocks_[axis]);
  }
  block_numbers_.assign(count, -1);
}

int TsdfVolume::BlockAt(int bx, int by, int bz) const {
  if (bx < 0 || by < 0 || bz < 0 || bx >= blocks_[0] || by >= blocks_[1] || bz >= blocks_[2]) {
    return -1;
  }
  return block_numbers_[(static_cast<std::size_t>(bz) * blocks_[1] + by) * blocks_[0] + bx];
}

std::int64_t TsdfVolume::IndexOf(int x, int y, int z) const {
  if (x < 0 || y < 0 || z < 0) return -1;
  const int block = BlockAt(x / kSide, y / kSide, z / kSide);
  if (block < 0) return -1;
  return static_cast<std::int64_t>(block) * kBlockVoxels +
         ((z % kSide) * kSide + y % kSide) * kSide + x % kSide;
}

TsdfVolume::Voxel TsdfVolume::At(const Lattice& point) const {
  const std::int64_t index = IndexOf(point[0], point[1], point[2]);
  if (index < 0) return {};
  return {distances_[index] * truncation_m_, weights_[index]};
}

bool TsdfVolume::Interpolate(const Vector3f& position, float& distance_m) const {
  const float x = std::floor(position.x()), y = std::floor(position.y()),
              z = std::floor(position.z());
  if (!(x >= 0.0f && y >= 0.0f && z >= 0.0f)) return false;
  const int i = static_cast<int>(x), j = static_cast<int>(y), k = static_cast<int>(z);
  std::array<float, 8> corners;
  const int li = i % kSide, lj = j % kSide, lk = k % kSide;
  if (li < kSide - 1 && lj < kSide - 1 && lk < kSide - 1) {  // all in one block
    const std::int64_t first = IndexOf(i, j, k);
    if (first < 0) return false;
    for (int c = 0; c < 8; ++c) {
      const std::int64_t index =
          first + (c & 1) + kSide * ((c >> 1) & 1) + kSide * kSide * (c >> 2);
      if (weights_[index] <= 0.0f) return false;
      corners[c] = distances_[index];
    }
  } else {
    for (int c = 0; c < 8; ++c) {
      const std::int64_t index = IndexOf(i + (c & 1), j + ((c >> 1) & 1), k + (c >> 2));
      if (index < 0 || weights_[index] <= 0.0f) return false;
      corners[c] = distances_[index];
    }
  }
  const float fx = position.x() - x, fy = position.y() - y, fz = position.z() - z;
  for (int c = 0; c < 8; c += 2) corners[c] += fx * (corners[c + 1] - corners[c]);
  for (int c = 0; c < 8; c += 4) corners[c] += fy * (corners[c + 2] - corners[c]);
  distance_m = (corners[0] + fz * (corners[4] - corners[0])) * truncation_m_;
  return true;
}

void TsdfVolume::MakeBlock(const Vector3f& point_in_subject) {
  const Vector3f position = ToLattice(point_in_subject) / static_cast<float>(kSide);
  const int bx = static_cast<int>(std::floor(position.x()));
  const int by = static_cast<int>(std::floor(position.y()));
  const int bz = static_cast<int>(std::floor(position.z()));
  if (bx < 0 || by < 0 || bz < 0 || bx >= blocks_[0] || by >= blocks_[1] || bz >= blocks_[2]) {
    return;
  }
  std::int32_t& number =
      block_numbers_[(static_cast<std::size_t>(bz) * blocks_[1] + by) * blocks_[0] + bx];
  if (number >= 0) return;
  if (block_count() == kMaxBlocks) {
    throw RunError(
        fmt::format("scan: the surface seen fills more than {} blocks of {}³ voxels of {:g} m; no "
                    "body does: enlarge volume.voxel_m or look at the depth frames",
                    kMaxBlocks, kSide, settings_.voxel_m));
  }
  number = block_count();
  block_corners_.push_back({bx * kSide, by * kSide, bz * kSide});
}

// Blocks on the rays through the seen points, from a truncation before to a truncation behind.
void TsdfVolume::MakeRoom(const PointMap& seen, const Rigidd& subject_from_camera) {
  const Rigidf transform = subject_from_camera.Cast<float>();
  const float step_m = std::min(0.5f * kSide * voxel_m_, truncation_m_);
  const int steps = static_cast<int>(std::ceil(truncation_m_ / step_m));
  for (int v = 0; v < seen.points.height(); ++v) {
    for (int u = 0; u < seen.points.width(); ++u) {
      if (!seen.Has(u, v)) continue;
      const Vector3f& point = seen.points(u, v);
      const Vector3f in_subject = transform * point;
      const Vector3f step =
          transform.rotation * point.normalized() * (truncation_m_ / static_cast<float>(steps));
      for (int s = -steps; s <= steps; ++s) MakeBlock(in_subject + static_cast<float>(s) * step);
    }
  }
  const std::size_t voxels = static_cast<std::size_t>(block_count()) * kBlockVoxels;
  distances_.resize(voxels, 1.0f);
  weights_.resize(voxels, 0.0f);
}

// What integration wants to know of each pixel.
struct TsdfVolume::View {
  const DepthImage& depth;
  PinholeCamera camera;
  Rigidf camera_from_subject;
  Image<float> across;  // metres across the surface per metre of depth; 0: not to be used
  Image<float> weight;
  int tile_columns = 0;
  std::vector<float> nearest, farthest;  // depth of the pixels of each tile; farthest 0: none
  float jump_m = 0.0f;

  static constexpr int kTile = 8;  // pixels

  View(const DepthImage& depth_in, const PointMap& seen, const PinholeCamera& camera_in,
       const Rigidd& subject_from_camera, const VolumeSettings& settings)
      : depth(depth_in),
        camera(camera_in),
        camera_from_subject(Inverse(subject_from_camera).Cast<float>()),
        across(depth.width(), depth.height()),
        weight(depth.width(), depth.height()),
        tile_columns((depth.width() + kTile - 1) / kTile),
        jump_m(static_cast<float>(settings.depth_jump_m)) {
    const int tile_rows = (depth.height() + kTile - 1) / kTile;
    nearest.assign(static_cast<std::size_t>(tile_columns) * tile_rows, 0.0f);
    farthest = nearest;
    for (int v = 0; v < depth.height(); ++v) {
      for (int u = 0; u < depth.width(); ++u) {
        if (!seen.Has(u, v)) continue;
        const float z = depth(u, v);
        const Vector3f ray = seen.points(u, v) / seen.points(u, v).z();
        const float slope = -seen.normals(u, v).dot(ray);
        const float cosine = slope / ray.norm();
        if (cosine < static_cast<float>(settings.min_cosine) || cosine <= 0.0f) continue;
        across(u, v) = slope;
        weight(u, v) = cosine / (z * ray.norm());  // KF, sec. 3.3: W ∝ cos θ / R
        const std::size_t tile = static_cast<std::size_t>(v / kTile) * tile_columns + u / kTile;
        nearest[tile] = farthest[tile] == 0.0f ? z : std::min(nearest[tile], z);
        farthest[tile] = std::max(farthest[tile], z);
      }
    }
  }

  // Depth between pixel centres: bilinear within a surface, the nearest pixel's elsewhere.
  float DepthAt(float u, float v, int nearest_u, int nearest_v) const {
    const int u0 = static_cast<int>(u), v0 = static_cast<int>(v);
    const float here = depth(nearest_u, nearest_v);
    if (u < 0.0f || v < 0.0f || u0 + 1 >= depth.width() || v0 + 1 >= depth.height()) return here;
    const float a = depth(u0, v0), b = depth(u0 + 1, v0), c = depth(u0, v0 + 1),
                d = depth(u0 + 1, v0 + 1);
    const float low = std::min(std::min(a, b), std::min(c, d));
    const float high = std::max(std::max(a, b), std::max(c, d));
    if (low <= 0.0f || high - low > jump_m) return here;
    const float fu = u - static_cast<float>(u0), fv = v - static_cast<float>(v0);
    const float top = a + fu * (b - a), bottom = c + fu * (d - c);
    return top + fv * (bottom - top);
  }

  // Whether any pixel can change a ball's voxels: it is in view and not wholly behind what is seen.
  bool Reaches(const Vector3f& center, float radius_m, float truncation_m) const {
    const float near_z = center.z() - radius_m;
    if (near_z <= 0.0f) return center.z() + radius_m > 0.0f;
    const auto first = [](double low, int limit) {
      return std::clamp(static_cast<int>(std::floor(low)), 0, limit) / kTile;
    };
    const double fu = camera.fx / near_z, fv = camera.fy / near_z;
    const double u = camera.cx + camera.fx * center.x() / center.z();
    const double v = camera.cy + camera.fy * center.y() / center.z();
    const double ru = fu * radius_m * kPerspective, rv = fv * radius_m * kPerspective;
    if (u + ru < 0.0 || v + rv < 0.0 || u - ru > camera.width || v - rv > camera.height) {
      return false;
    }
    for (int tv = first(v - rv, camera.height - 1); tv <= first(v + rv, camera.height - 1); ++tv) {
      for (int tu = first(u - ru, camera.width - 1); tu <= first(u + ru, camera.width - 1); ++tu) {
        const std::size_t tile = static_cast<std::size_t>(tv) * tile_columns + tu;
        if (farthest[tile] > 0.0f && near_z <= farthest[tile] + truncation_m) return true;
      }
    }
    return false;
  }

  static constexpr double kPerspective = 1.3;  // a ball's outline away from the image's middle
};

void TsdfVolume::IntegrateBlock(int block, const View& view) {
  const Lattice& corner = block_corners_[static_cast<std::size_t>(block)];
  const Vector3f low = FromLattice({static_cast<float>(corner[0]), static_cast<float>(corner[1]),
                                    static_cast<float>(corner[2])});
  const float half = 0.5f * (kSide - 1) * voxel_m_;
  const Vector3f middle = view.camera_from_subject * (low + Vector3f::Constant(half));
  // A slope of min_cosine lets depth differ by more than the truncation where distance does not.
  const float reach_m = truncation_m_ / std::max(static_cast<float>(settings_.min_cosine), 0.05f);
  if (!view.Reaches(middle, std::sqrt(3.0f) * half, reach_m)) return;

  const Vector3f first = view.camera_from_subject * low;
  const Matrix3<float> axes = view.camera_from_subject.rotation * voxel_m_;
  const auto fx = static_cast<float>(view.camera.fx), fy = static_cast<float>(view.camera.fy);
  const auto cx = static_cast<float>(view.camera.cx), cy = static_cast<float>(view.camera.cy);
  const float u_end = static_cast<float>(view.depth.width()) - 0.5f;
  const float v_end = static_cast<float>(view.depth.height()) - 0.5f;
  const auto max_weight = static_cast<float>(settings_.max_weight);
  const float per_truncation = 1.0f / truncation_m_;
  float* distance = distances_.data() + static_cast<std::size_t>(block) * kBlockVoxels;
  float* weight = weights_.data() + static_cast<std::size_t>(block) * kBlockVoxels;
  for (int z = 0; z < kSide; ++z) {
    for (int y = 0; y < kSide; ++y) {
      const Vector3f row =
          first + static_cast<float>(y) * axes.col(1) + static_cast<float>(z) * axes.col(2);
      for (int x = 0; x < kSide; ++x, ++distance, ++weight) {
        const Vector3f p = row + static_cast<float>(x) * axes.col(0);
        if (p.z() <= 0.0f) continue;
        const float inverse_z = 1.0f / p.z();
        const float u = fx * p.x() * inverse_z + cx, v = fy * p.y() * inverse_z + cy;
        if (!(u >= -0.5f && v >= -0.5f && u < u_end && v < v_end)) continue;
        const int nearest_u = static_cast<int>(u + 0.5f), nearest_v = static_cast<int>(v + 0.5f);
        const float across = view.across(nearest_u, nearest_v);
        if (across == 0.0f) continue;
        const float seen_z = view.DepthAt(u, v, nearest_u, nearest_v);
        const float d = (seen_z - p.z()) * across * per_truncation;
        if (d <= -1.0f) continue;
        const float fade = d < -kFullWeightBehind ? (1.0f + d) / (1.0f - kFullWeightBehind) : 1.0f;
        const float w = view.weight(nearest_u, nearest_v) * fade;
        *distance = (*distance * *weight + std::min(d, 1.0f) * w) / (*weight + w);
        *weight = std::min(*weight + w, max_weight);
      }
    }
  }
}

void TsdfVolume::Integrate(const DepthImage& depth, const PointMap& seen,
                           const PinholeCamera& camera, const Rigidd& subject_from_camera,
                           int threads) {
  MakeRoom(seen, subject_from_camera);
  const View view(depth, seen, camera, subject_from_camera, settings_);
  ParallelFor(block_count(), threads, [&](int begin, int end) {
    for (int block = begin; block < end; ++block) IntegrateBlock(block, view);
  });
}

}  // namespace vitruvia
