#include "methods/dynamic/association.h"

#include <algorithm>
#include <cmath>

#include "methods/dynamic/blend.h"

namespace vitruvia::dynamic {
namespace {

constexpr float kNearest_m = 0.05f;    // vertices nearer to the camera are not projected
constexpr float kRounding_px = 1e-2f;  // the search goes that much farther than exact numbers ask
constexpr int kPointsPerRange = 512;

float LongestRay(double focal_px, double center_px, int size_px) {
  const double off = std::max(std::abs(center_px + 0.5), std::abs(size_px - 0.5 - center_px));
  return static_cast<float>(std::hypot(focal_px, off));
}

}  // namespace

Association::Association(const PinholeCamera& camera, const SurfaceLayout& layout)
    : camera_(camera),
      layout_(&layout),
      widest_ray_px_(std::max(LongestRay(camera.fx, camera.cx, camera.width),
                              LongestRay(camera.fy, camera.cy, camera.height))),
      pixels_(layout.slot_count(), -1),
      bucket_begin_(static_cast<std::size_t>(camera.width) * camera.height + 1, 0) {
  entries_.reserve(layout.slot_count());
  nearest_.reserve(static_cast<std::size_t>(camera.width) * camera.height);
}

void Association::ProjectPatch(const Patch& patch, const Surface<float>& surface,
                               const AssociationLimits& limits) {
  using Lane = Lanes<float>;
  using LaneInt = Eigen::Array<int, kLanes, 1>;
  const auto fx = static_cast<float>(camera_.fx), fy = static_cast<float>(camera_.fy);
  const auto cx = static_cast<float>(camera_.cx), cy = static_cast<float>(camera_.cy);
  const auto last_u = static_cast<float>(camera_.width) - 0.5f;
  const auto last_v = static_cast<float>(camera_.height) - 0.5f;
  const float cosine_squared = limits.facing_cosine * limits.facing_cosine;
  for (int slot = patch.begin; slot < patch.end; slot += kLanes) {
    const auto p = LaneVector<float>::Load(surface.posed, slot);
    const auto n = LaneVector<float>::Load(surface.normals, slot);
    const Lane inverse_z = p.z.inverse();
    const Lane u = fx * p.x * inverse_z + cx, v = fy * p.y * inverse_z + cy;
    const Lane towards = -Dot(n, p);
    const auto usable = p.z > kNearest_m && towards > 0.0f &&
                        towards * towards > cosine_squared * Dot(p, p) && u >= -0.5f &&
                        v >= -0.5f && u < last_u && v < last_v;
    // What is not usable may be too large for an integer.
    const Lane column = usable.select((u + 0.5f).floor(), 0.0f);
    const Lane row = usable.select((v + 0.5f).floor(), 0.0f);
    const LaneInt pixel = row.cast<int>() * camera_.width + column.cast<int>();
    Eigen::Map<LaneInt>(pixels_.data() + slot) = usable.select(pixel, -1);
    for (int i = slot; i < slot + kLanes; ++i) {
      if (layout_->vertex_of_slot[i] < 0) pixels_[i] = -1;
    }
  }
}

void Association::FillBuckets(const Surface<float>& surface) {
  int lowest = static_cast<int>(bucket_begin_.size()), highest = -1, count = 0;
  for (const int pixel : pixels_) {
    if (pixel < 0) continue;
    lowest = std::min(lowest, pixel);
    highest = std::max(highest, pixel);
    ++count;
  }
  entries_.resize(count);
  first_row_ = lowest / camera_.width;
  last_row_ = highest < 0 ? -1 : highest / camera_.width;
  if (count == 0) return;
  // A counting sort: sizes, ends, then the entries from the back, which turns ends into begins.
  const int begin = first_row_ * camera_.width, end = (last_row_ + 1) * camera_.width;
  std::fill(bucket_begin_.begin() + begin, bucket_begin_.begin() + end + 1, 0);
  for (const int pixel : pixels_) {
    if (pixel >= 0) ++bucket_begin_[pixel];
  }
  int sum = 0;
  for (int pixel = begin; pixel <= end; ++pixel) {
    if (pixel < end) sum += bucket_begin_[pixel];
    bucket_begin_[pixel] = sum;
  }
  for (int slot = static_cast<int>(pixels_.size()) - 1; slot >= 0; --slot) {
    if (pixels_[slot] < 0) continue;
    entries_[--bucket_begin_[pixels_[slot]]] = {surface.posed.x[slot], surface.posed.y[slot],
                                                surface.posed.z[slot], slot};
  }
}

void Association::FindNearest(const PointCloud& cloud, const AssociationLimits& limits,
                              WorkerTeam& team) {
  nearest_.resize(cloud.points.size());
  team.For(static_cast<int>(cloud.points.size()), kPointsPerRange, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      nearest_[i] = NearestTo(cloud.points[i], cloud.pixels[i], limits);
    }
  });
}

// The columns of one row of pixels hold their entries side by side.
void Association::ScanRow(const Vector3f& point, int row, int first_column, int last_column,
                          Best& best) const {
  if (row < first_row_ || row > last_row_) return;
  const int at = row * camera_.width;
  const int begin = bucket_begin_[at + std::max(first_column, 0)];
  const int end = bucket_begin_[at + std::min(last_column, camera_.width - 1) + 1];
  for (int i = begin; i < end; ++i) {
    const Entry& e = entries_[i];
    const float dx = e.x - point.x(), dy = e.y - point.y(), dz = e.z - point.z();
    const float squared = dx * dx + dy * dy + dz * dz;
    if (squared < best.squared || (squared == best.squared && e.slot < best.slot)) {
      best = {squared, e.slot};
    }
  }
}

// A vertex whose pixel is m columns (or rows) from the point's lies beyond the plane through the
// camera at m − ½ columns, so at least z (m − ½) / |(fx, u − cx)| from the point.
int Association::NearestTo(const Vector3f& point, int pixel,
                           const AssociationLimits& limits) const {
  const int column = pixel % camera_.width, row = pixel / camera_.width;
  const float px_per_m = widest_ray_px_ / point.z();
  const auto reach = [&](float squared) {
    return std::min(static_cast<float>(limits.window_px),
                    std::sqrt(squared) * px_per_m + 0.5f + kRounding_px);
  };
  Best best{limits.cutoff_m * limits.cutoff_m, -1};
  // Most points end here: the eight pixels round their own hold a vertex as close as a pixel.
  const int first = std::min(1, limits.window_px);
  for (int r = row - first; r <= row + first; ++r) {
    ScanRow(point, r, column - first, column + first, best);
  }
  auto radius = static_cast<int>(reach(best.squared));
  if (radius <= first) return best.slot;
  for (int m = 0; m <= radius; ++m) {
    ScanRow(point, row - m, column - radius, column + radius, best);
    if (m > 0) ScanRow(point, row + m, column - radius, column + radius, best);
    radius = static_cast<int>(reach(best.squared));
  }
  return best.slot;
}

void Association::Observe(const PointCloud& cloud, Observations<float>& observations) const {
  observations.Reset(layout_->slot_count());
  for (std::size_t i = 0; i < nearest_.size(); ++i) {
    if (nearest_[i] >= 0) observations.Add(nearest_[i], cloud.points[i]);
  }
}

}  // namespace vitruvia::dynamic
