#include "methods/dynamic/association.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace vitruvia::dynamic {
namespace {

constexpr float kNearest_m = 0.05f;    // vertices nearer to the camera are not projected
constexpr float kRounding_px = 1e-2f;  // the search goes that much farther than exact numbers ask
constexpr int kPointsPerRange = 512;

void FillRays(double focal_px, double center_px, int window_px, std::vector<float>& rays) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const double off = std::abs(static_cast<double>(i) - center_px) + window_px + 0.5;
    rays[i] = static_cast<float>(std::hypot(focal_px, off));
  }
}

}  // namespace

Association::Association(const PinholeCamera& camera, const SurfaceLayout& layout)
    : camera_(camera),
      layout_(&layout),
      pixels_(layout.slot_count(), -1),
      bucket_begin_(static_cast<std::size_t>(camera.width) * camera.height + 1, 0),
      column_ray_(camera.width),
      row_ray_(camera.height) {
  facing_.reserve(pixels_.size());
  sorted_.Resize(layout.slot_count() + kLanes);
  sorted_slots_.resize(layout.slot_count() + kLanes);
  nearest_.reserve(static_cast<std::size_t>(camera.width) * camera.height);
}

// One plain loop over numbers side by side: the compiler makes eight lanes of it.
void Association::ProjectPatch(const Patch& patch, const Surface<float>& surface,
                               const AssociationLimits& limits) {
  const auto fx = static_cast<float>(camera_.fx), fy = static_cast<float>(camera_.fy);
  const auto cx = static_cast<float>(camera_.cx), cy = static_cast<float>(camera_.cy);
  const auto width = static_cast<float>(camera_.width), height = static_cast<float>(camera_.height);
  const float cosine_squared = limits.facing_cosine * limits.facing_cosine;
  const int columns = camera_.width;
  const float *x = surface.posed.x.data(), *y = surface.posed.y.data(), *z = surface.posed.z.data();
  const float *nx = surface.normals.x.data(), *ny = surface.normals.y.data(),
              *nz = surface.normals.z.data();
  int* pixels = pixels_.data();
  for (int i = patch.begin; i < patch.end; ++i) {
    const float inverse_z = 1.0f / z[i];
    const float u = fx * x[i] * inverse_z + cx + 0.5f, v = fy * y[i] * inverse_z + cy + 0.5f;
    const float towards = -(nx[i] * x[i] + ny[i] * y[i] + nz[i] * z[i]);
    const float square = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
    // A slot that was filled up has a normal of zero, so it faces nothing.
    const bool usable = (z[i] > kNearest_m) & (towards > 0.0f) &
                        (towards * towards > cosine_squared * square) & (u >= 0.0f) & (v >= 0.0f) &
                        (u < width) & (v < height);
    // What is not usable may be too large for an integer.
    const int column = static_cast<int>(usable ? u : 0.0f);
    const int row = static_cast<int>(usable ? v : 0.0f);
    pixels[i] = usable ? row * columns + column : -1;
  }
}

// Without a branch that could be foreseen wrongly.
void Association::FindFacing() {
  int lowest = static_cast<int>(bucket_begin_.size()), highest = -1, count = 0;
  facing_.resize(pixels_.size());
  for (int slot = 0; slot < static_cast<int>(pixels_.size()); ++slot) {
    const int pixel = pixels_[slot];
    const bool faces = pixel >= 0;
    facing_[count] = slot;
    count += faces ? 1 : 0;
    lowest = std::min(lowest, faces ? pixel : lowest);
    highest = std::max(highest, pixel);
  }
  facing_.resize(count);
  first_row_ = lowest / camera_.width;
  last_row_ = highest < 0 ? -1 : highest / camera_.width;
}

// A counting sort: sizes, ends, then the entries from the back, which turns ends into begins.
void Association::SortIntoBuckets(const Surface<float>& surface, int begin, int end) {
  const auto mine = [&](int slot) { return pixels_[slot] >= begin && pixels_[slot] < end; };
  std::fill(bucket_begin_.begin() + begin, bucket_begin_.begin() + end, 0);
  int entries = 0;
  for (const int slot : facing_) {
    if (!mine(slot)) continue;
    ++bucket_begin_[pixels_[slot]];
    ++entries;
  }
  // The first pixels' entries come first; those of the last end with the last entry.
  int sum = begin == first_row_ * camera_.width ? 0 : static_cast<int>(facing_.size()) - entries;
  for (int pixel = begin; pixel < end; ++pixel) bucket_begin_[pixel] = sum += bucket_begin_[pixel];
  for (auto slot = facing_.rbegin(); slot != facing_.rend(); ++slot) {
    if (!mine(*slot)) continue;
    const int at = --bucket_begin_[pixels_[*slot]];
    sorted_.Set(at, surface.posed.At(*slot));
    sorted_slots_[at] = *slot;
  }
}

void Association::FillBuckets(const Surface<float>& surface, WorkerTeam& team) {
  FindFacing();
  if (facing_.empty()) return;
  const int rows = last_row_ + 1 - first_row_;
  constexpr int kParts = 2;  // so that none has to wait for another's count
  team.For(kParts, 1, [&](int part, int next) {
    SortIntoBuckets(surface, (first_row_ + rows * part / kParts) * camera_.width,
                    (first_row_ + rows * next / kParts) * camera_.width);
  });
  bucket_begin_[static_cast<std::size_t>(last_row_ + 1) * camera_.width] =
      static_cast<int>(facing_.size());
}

void Association::FindLongestRays(int window_px) {
  FillRays(camera_.fx, camera_.cx, window_px, column_ray_);
  FillRays(camera_.fy, camera_.cy, window_px, row_ray_);
}

// The columns of one row of pixels hold their vertices side by side. Eight are looked at at once,
// without a branch that could be foreseen wrongly; the best of the eight lanes is told at the end.
inline void Association::ScanRow(const Vector3f& point, int row, int first_column, int last_column,
                                 Best& best) const {
  if (row < first_row_ || row > last_row_) return;
  const int at = row * camera_.width;
  const int begin = bucket_begin_[at + std::max(first_column, 0)];
  const int end = bucket_begin_[at + std::min(last_column, camera_.width - 1) + 1];
  constexpr Ints kLaneIndex = {0, 1, 2, 3, 4, 5, 6, 7};
  for (int first = begin; first < end; first += kLanes) {
    Floats x, y, z;
    Ints slots;
    std::memcpy(&x, &sorted_.x[first], sizeof x);
    std::memcpy(&y, &sorted_.y[first], sizeof y);
    std::memcpy(&z, &sorted_.z[first], sizeof z);
    std::memcpy(&slots, &sorted_slots_[first], sizeof slots);
    const Floats dx = x - point.x(), dy = y - point.y(), dz = z - point.z();
    const Floats squared = dx * dx + dy * dy + dz * dz;
    const Ints better =
        (kLaneIndex < end - first) &
        ((squared < best.squared) | ((squared == best.squared) & (slots < best.slot)));
    best.squared = better ? squared : best.squared;
    best.slot = better ? slots : best.slot;
  }
}

// A vertex whose pixel is m columns (or rows) from the point's lies beyond the plane through the
// camera at m − ½ columns, so at least z (m − ½) / |(u − cx, fx)| from the point.
int Association::NearestTo(const Vector3f& point, int pixel,
                           const AssociationLimits& limits) const {
  const int column = pixel % camera_.width, row = pixel / camera_.width;
  const float px_per_m = std::max(column_ray_[column], row_ray_[row]) / point.z();
  Best best;
  best.squared = Floats{} + limits.cutoff_m * limits.cutoff_m;
  best.slot = Ints{} - 1;  // a vertex exactly at the cutoff is not taken
  const auto radius = [&] {
    float squared = best.squared[0];
    for (int i = 1; i < kLanes; ++i) squared = std::min(squared, best.squared[i]);
    return static_cast<int>(std::min(static_cast<float>(limits.window_px),
                                     std::sqrt(squared) * px_per_m + 0.5f + kRounding_px));
  };
  // Most points end among the eight pixels round their own.
  const int first = std::min(1, limits.window_px);
  for (int r = row - first; r <= row + first; ++r) {
    ScanRow(point, r, column - first, column + first, best);
  }
  int reach = radius();
  for (int m = 0; reach > first && m <= reach; ++m) {
    ScanRow(point, row - m, column - reach, column + reach, best);
    if (m > 0) ScanRow(point, row + m, column - reach, column + reach, best);
    reach = radius();
  }
  int lane = 0;  // lanes that found nothing hold the cutoff
  for (int i = 1; i < kLanes; ++i) {
    const bool nearer = best.squared[i] < best.squared[lane];
    const bool as_near = best.squared[i] == best.squared[lane];
    if (nearer || (as_near && best.slot[i] >= 0 && best.slot[i] < best.slot[lane])) lane = i;
  }
  return best.slot[lane];
}

void Association::FindNearest(const PointCloud& cloud, const AssociationLimits& limits,
                              WorkerTeam& team) {
  nearest_.resize(cloud.points.size());
  FindLongestRays(limits.window_px);
  team.For(static_cast<int>(cloud.points.size()), kPointsPerRange, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      nearest_[i] = NearestTo(cloud.points[i], cloud.pixels[i], limits);
    }
  });
}

void Association::Observe(const PointCloud& cloud, Observations<float>& observations) const {
  observations.Reset(layout_->slot_count());
  for (std::size_t i = 0; i < nearest_.size(); ++i) {
    if (nearest_[i] >= 0) observations.Add(nearest_[i], cloud.points[i]);
  }
}

}  // namespace vitruvia::dynamic
