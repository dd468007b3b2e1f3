#include "learning/scan/tsdf_volume.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/error.h"
#include "learning/scan/gathered.h"
#include "math/lanes.h"
#include "math/rigid.h"

namespace vitruvia {
namespace {

constexpr int kMaxBlocks = 200000;  // 100 million voxels: ten times what a body needs at 3 mm
// Behind the surface a voxel's weight decreases to zero, so that the far side of a thin part (a
// hand) is not overwritten by its near side. Up to this share of the truncation the weight is
// constant; otherwise noise would have different weights on the two sides of the surface.
constexpr float kFullWeightBehind = 0.5f;

constexpr int kSide = TsdfVolume::kBlockSide, kSideBits = TsdfVolume::kBlockBits;
constexpr int kSideMask = kSide - 1;

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

TsdfVolume::Voxel TsdfVolume::At(const Lattice& point) const {
  const std::int64_t index = IndexOf(point[0], point[1], point[2]);
  if (index < 0) return {};
  return {cells_[index].distance * truncation_m_, cells_[index].weight};
}

bool TsdfVolume::Interpolate(const Vector3f& position, float& distance_m) const {
  const float x = std::floor(position.x()), y = std::floor(position.y()),
              z = std::floor(position.z());
  if (!(x >= 0.0f && y >= 0.0f && z >= 0.0f)) return false;
  const int i = static_cast<int>(x), j = static_cast<int>(y), k = static_cast<int>(z);
  std::array<float, 8> corners;
  if ((i & kSideMask) < kSideMask && (j & kSideMask) < kSideMask &&
      (k & kSideMask) < kSideMask) {  // all in one block
    const std::int64_t first = IndexOf(i, j, k);
    if (first < 0) return false;
    for (int c = 0; c < 8; ++c) {
      const std::int64_t index =
          first + (c & 1) + kSide * ((c >> 1) & 1) + kSide * kSide * (c >> 2);
      if (cells_[index].weight <= 0.0f) return false;
      corners[c] = cells_[index].distance;
    }
  } else {
    for (int c = 0; c < 8; ++c) {
      const std::int64_t index = IndexOf(i + (c & 1), j + ((c >> 1) & 1), k + (c >> 2));
      if (index < 0 || cells_[index].weight <= 0.0f) return false;
      corners[c] = cells_[index].distance;
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
  cells_.resize(static_cast<std::size_t>(block_count()) * kBlockVoxels);
}

namespace {

// The eight voxels of a row, on their way into the image.
struct VoxelRows {
  struct Row {
    FloatLanes z, u, v;
    IntLanes in_view;
  };

  VoxelRows(const Vector3f& step, const PinholeCamera& camera, int width, int height)
      : steps_x(kSteps * step.x()),
        steps_y(kSteps * step.y()),
        steps_z(kSteps * step.z()),
        fx(static_cast<float>(camera.fx)),
        fy(static_cast<float>(camera.fy)),
        cx(static_cast<float>(camera.cx)),
        cy(static_cast<float>(camera.cy)),
        u_end(static_cast<float>(width) - 0.5f),
        v_end(static_cast<float>(height) - 0.5f) {}

  Row At(const Vector3f& first) const {
    const FloatLanes z = first.z() + steps_z, inverse = 1.0f / z;
    const FloatLanes u = fx * (first.x() + steps_x) * inverse + cx;
    const FloatLanes v = fy * (first.y() + steps_y) * inverse + cy;
    return {z, u, v, (z > 0.0f) & (u >= -0.5f) & (v >= -0.5f) & (u < u_end) & (v < v_end)};
  }

  static constexpr FloatLanes kSteps = {0, 1, 2, 3, 4, 5, 6, 7};
  FloatLanes steps_x, steps_y, steps_z;
  float fx, fy, cx, cy, u_end, v_end;
};

// Eight cells, whose distances and weights lie alternately.
struct CellLanes {
  FloatLanes distance, weight;

  explicit CellLanes(const float* cells) {
    FloatLanes a, b;
    std::memcpy(&a, cells, sizeof a);
    std::memcpy(&b, cells + kLanes, sizeof b);
    distance = __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14);
    weight = __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15);
  }
  void Store(float* cells) const {
    const FloatLanes a = __builtin_shufflevector(distance, weight, 0, 8, 1, 9, 2, 10, 3, 11);
    const FloatLanes b = __builtin_shufflevector(distance, weight, 4, 12, 5, 13, 6, 14, 7, 15);
    std::memcpy(cells, &a, sizeof a);
    std::memcpy(cells + kLanes, &b, sizeof b);
  }
};

}  // namespace

// Data of each pixel for integration.
struct TsdfVolume::View {
  struct Pixel {
    float depth_m = 0.0f;
    float across = 0.0f;  // metres across the surface per metre of depth; 0: not to be used
    float weight = 0.0f;
    float behind = 0.0f;  // in truncations: how far behind the surface the pixel speaks
  };

  const DepthImage& depth;
  PinholeCamera camera;
  Rigidf camera_from_subject;
  Image<Pixel> pixels;
  Image<std::int32_t> smooth;  // −1: this pixel and those right, below and both are one surface
  int tile_columns = 0;
  std::vector<float> farthest;  // depth of the usable pixels of each tile; 0: none

  View(const DepthImage& depth_in, const PointMap& seen, const PinholeCamera& camera_in,
       const Rigidd& subject_from_camera, const VolumeSettings& settings)
      : depth(depth_in),
        camera(camera_in),
        camera_from_subject(Inverse(subject_from_camera).Cast<float>()),
        pixels(depth.width(), depth.height()),
        smooth(depth.width(), depth.height()),
        tile_columns((depth.width() + kTile - 1) / kTile),
        farthest(static_cast<std::size_t>(tile_columns) * ((depth.height() + kTile - 1) / kTile)) {
    const auto jump_m = static_cast<float>(settings.depth_jump_m);
    for (int v = 0; v < depth.height(); ++v) {
      for (int u = 0; u < depth.width(); ++u) {
        if (!seen.Has(u, v)) continue;
        const float z = depth(u, v);
        smooth(u, v) = IsSmooth(depth, u, v, jump_m) ? -1 : 0;
        const Vector3f ray = seen.points(u, v) / seen.points(u, v).z();
        const float across = -seen.normals(u, v).dot(ray), ray_length = ray.norm();
        const float cosine = across / ray_length;
        if (cosine < static_cast<float>(settings.min_cosine) || cosine <= 0.0f) continue;
        // KF, sec. 3.3: W ∝ cos θ / R. A ray at a grazing angle soon leaves a round body again, so
        // the range behind its pixel is shortened too.
        pixels(u, v) = {z, across, cosine / (z * ray_length), cosine * cosine};
        float& far_z = farthest[static_cast<std::size_t>(v / kTile) * tile_columns + u / kTile];
        far_z = std::max(far_z, z);
      }
    }
  }

  static bool IsSmooth(const DepthImage& depth, int u, int v, float jump_m) {
    if (u + 1 >= depth.width() || v + 1 >= depth.height()) return false;
    const float a = depth(u, v), b = depth(u + 1, v), c = depth(u, v + 1), d = depth(u + 1, v + 1);
    const float low = std::min(std::min(a, b), std::min(c, d));
    const float high = std::max(std::max(a, b), std::max(c, d));
    return low > 0.0f && high - low <= jump_m;
  }

  // Depth between pixel centres: bilinear within a surface, the nearest pixel's elsewhere. Only
  // lanes that are in view may be used.
  FloatLanes DepthAt(const FloatLanes& u, const FloatLanes& v, const FloatLanes& nearest_m,
                     const IntLanes& in_view) const {
    const IntLanes inside = in_view & (u >= 0.0f) & (v >= 0.0f);
    const IntLanes u0 = Truncate(inside ? u : FloatLanes{});
    const IntLanes v0 = Truncate(inside ? v : FloatLanes{});
    const IntLanes pixel = v0 * depth.width() + u0;
    const IntLanes is_smooth = inside & Gathered(smooth.pixels().data(), pixel);
    if (Bits(is_smooth) == 0) return nearest_m;
    const IntLanes from = is_smooth ? pixel : IntLanes{};  // with neighbours right and below
    const FloatLanes fu = u - __builtin_convertvector(u0, FloatLanes);
    const FloatLanes fv = v - __builtin_convertvector(v0, FloatLanes);
    const float* above = depth.pixels().data();
    const float* below = above + depth.width();
    const auto left_above = Gathered(above, from);
    const auto left_below = Gathered(below, from);
    const FloatLanes top = left_above + fu * (Gathered(above + 1, from) - left_above);
    const FloatLanes bottom = left_below + fu * (Gathered(below + 1, from) - left_below);
    return is_smooth ? top + fv * (bottom - top) : nearest_m;
  }

  // Whether any pixel can change a ball's voxels: it is in view and not wholly behind what is seen.
  bool Reaches(const Vector3f& center, float radius_m, float truncation_m) const {
    const float near_z = center.z() - radius_m;
    if (near_z <= 0.0f) return center.z() + radius_m > 0.0f;
    const double u = camera.cx + camera.fx * center.x() / center.z();
    const double v = camera.cy + camera.fy * center.y() / center.z();
    const double ru = camera.fx * radius_m / near_z * kPerspective;
    const double rv = camera.fy * radius_m / near_z * kPerspective;
    if (u + ru < 0.0 || v + rv < 0.0 || u - ru > camera.width || v - rv > camera.height) {
      return false;
    }
    const auto tile = [](double at, int limit) {
      return std::clamp(static_cast<int>(at), 0, limit - 1) / kTile;
    };
    for (int tv = tile(v - rv, camera.height); tv <= tile(v + rv, camera.height); ++tv) {
      for (int tu = tile(u - ru, camera.width); tu <= tile(u + ru, camera.width); ++tu) {
        const float far_z = farthest[static_cast<std::size_t>(tv) * tile_columns + tu];
        if (far_z > 0.0f && near_z <= far_z + truncation_m) return true;
      }
    }
    return false;
  }

  static constexpr float kPerspective = 1.3f;  // a ball's outline away from the image's middle
};

void TsdfVolume::IntegrateBlock(int block, const View& view) {
  static_assert(kSide == kLanes && sizeof(Cell) == 2 * sizeof(float));
  const Lattice& corner = block_corners_[static_cast<std::size_t>(block)];
  const Vector3f low = FromLattice({static_cast<float>(corner[0]), static_cast<float>(corner[1]),
                                    static_cast<float>(corner[2])});
  const float half = 0.5f * (kSide - 1) * voxel_m_;
  const Vector3f middle = view.camera_from_subject * (low + Vector3f::Constant(half));
  if (!view.Reaches(middle, std::sqrt(3.0f) * half, truncation_m_)) return;

  const Vector3f first = view.camera_from_subject * low;
  const Matrix3<float> axes = view.camera_from_subject.rotation * voxel_m_;
  const VoxelRows rows(axes.col(0), view.camera, view.pixels.width(), view.pixels.height());
  const auto max_weight = static_cast<float>(settings_.max_weight);
  const float per_truncation = 1.0f / truncation_m_;
  Cell* cells = cells_.data() + static_cast<std::size_t>(block) * kBlockVoxels;
  for (int yz = 0; yz < kSide * kSide; ++yz, cells += kSide) {
    const Vector3f start = first + static_cast<float>(yz & kSideMask) * axes.col(1) +
                           static_cast<float>(yz >> kSideBits) * axes.col(2);
    const auto [z, u, v, in_view] = rows.At(start);
    if (Bits(in_view) == 0) continue;
    // Not negative where in view, so that cutting off rounds.
    const IntLanes at_u = Truncate(in_view ? u + 0.5f : FloatLanes{});
    const IntLanes at_v = Truncate(in_view ? v + 0.5f : FloatLanes{});
    const IntLanes pixel = at_v * view.pixels.width() + at_u;
    const auto* pixels = reinterpret_cast<const float*>(view.pixels.pixels().data());
    const IntLanes number = pixel * static_cast<int>(sizeof(View::Pixel) / sizeof(float));
    const auto across = Gathered(pixels + 1, number);
    const IntLanes usable = in_view & (across != 0.0f);
    if (Bits(usable) == 0) continue;
    const auto depth = view.DepthAt(u, v, Gathered(pixels, number), in_view);
    const FloatLanes d = (depth - z) * across * per_truncation;
    // 1: the end of what counts.
    const FloatLanes behind = -d / Gathered(pixels + 3, number);
    const IntLanes counts = usable & ~(behind >= 1.0f);
    if (Bits(counts) == 0) continue;
    const FloatLanes one = FloatLanes{} + 1.0f;
    const FloatLanes fade =
        behind > kFullWeightBehind ? (1.0f - behind) / (1.0f - kFullWeightBehind) : one;
    const FloatLanes w = Gathered(pixels + 2, number) * fade;
    CellLanes row(reinterpret_cast<const float*>(cells));
    const FloatLanes sum = row.weight + w;
    const FloatLanes distance = (row.distance * row.weight + Min(d, one) * w) / sum;
    row.distance = counts ? distance : row.distance;
    row.weight = counts ? Min(sum, FloatLanes{} + max_weight) : row.weight;
    row.Store(reinterpret_cast<float*>(cells));
  }
}

void TsdfVolume::Integrate(const DepthImage& depth, const PointMap& seen,
                           const PinholeCamera& camera, const Rigidd& subject_from_camera,
                           WorkerTeam& team) {
  MakeRoom(seen, subject_from_camera);
  const View view(depth, seen, camera, subject_from_camera, settings_);
  team.For(block_count(), [&](int begin, int end) {
    for (int block = begin; block < end; ++block) IntegrateBlock(block, view);
  });
}

}  // namespace vitruvia
