#include "methods/dynamic/association.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

namespace vitruvia::dynamic {
namespace {

constexpr float kNearest_m = 0.05f;    // vertices nearer to the camera are not projected
constexpr float kRounding_px = 1e-2f;  // margin of the search for rounding errors
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
      facing_(layout.slot_count()),
      views_(layout.patches.size()),
      bucket_begin_(static_cast<std::size_t>(camera.width) * camera.height + 1, 0),
      column_ray_(camera.width),
      row_ray_(camera.height) {
  sorted_.Resize(layout.slot_count() + kLanes);
  sorted_slots_.resize(layout.slot_count() + kLanes);
  nearest_.reserve(static_cast<std::size_t>(camera.width) * camera.height);
}

void Association::ProjectPatch(int patch, const Surface<float>& surface,
                               const AssociationLimits& limits) {
  const auto fx = static_cast<float>(camera_.fx), fy = static_cast<float>(camera_.fy);
  const auto cx = static_cast<float>(camera_.cx), cy = static_cast<float>(camera_.cy);
  const auto width = static_cast<float>(camera_.width), height = static_cast<float>(camera_.height);
  const float cosine_squared = limits.facing_cosine * limits.facing_cosine;
  const int begin = layout_->patches[patch].begin, end = layout_->patches[patch].end;
  IntLanes lowest = IntLanes{} + std::numeric_limits<int>::max(), highest = IntLanes{} - 1;
  for (int slot = begin; slot < end; slot += kLanes) {
    const auto x = LoadLanes<FloatLanes>(surface.posed.x, slot),
               y = LoadLanes<FloatLanes>(surface.posed.y, slot),
               z = LoadLanes<FloatLanes>(surface.posed.z, slot);
    const auto nx = LoadLanes<FloatLanes>(surface.normals.x, slot),
               ny = LoadLanes<FloatLanes>(surface.normals.y, slot),
               nz = LoadLanes<FloatLanes>(surface.normals.z, slot);
    const FloatLanes inverse_z = 1.0f / z;
    const FloatLanes u = fx * x * inverse_z + cx + 0.5f, v = fy * y * inverse_z + cy + 0.5f;
    const FloatLanes towards = -(nx * x + ny * y + nz * z);
    const FloatLanes square = x * x + y * y + z * z;
    // A slot that was filled up has a normal of zero, so it faces nothing.
    const IntLanes usable = (z > kNearest_m) & (towards > 0.0f) &
                            (towards * towards > cosine_squared * square) & (u >= 0.0f) &
                            (v >= 0.0f) & (u < width) & (v < height);
    // What is not usable may be too large for an integer.
    const IntLanes column = __builtin_convertvector(usable ? u : FloatLanes{}, IntLanes);
    const IntLanes row = __builtin_convertvector(usable ? v : FloatLanes{}, IntLanes);
    const IntLanes pixel = usable ? row * camera_.width + column : IntLanes{} - 1;
    std::memcpy(&pixels_[slot], &pixel, sizeof pixel);
    const IntLanes candidate = usable ? pixel : lowest;
    lowest = candidate < lowest ? candidate : lowest;
    highest = pixel > highest ? pixel : highest;
  }
  // Branch-free, to avoid mispredictions.
  int count = 0;
  for (int slot = begin; slot < end; ++slot) {
    facing_[begin + count] = slot;
    count += pixels_[slot] >= 0 ? 1 : 0;
  }
  views_[patch] = {count, SmallestLane(lowest), -SmallestLane(-highest)};
}

// Calls body(slot, pixel) for the facing slots whose pixels are begin … end, patch after patch.
template <class Body>
void Association::ForEachFacingSlot(int begin_pixel, int end_pixel, const Body& body) const {
  for (std::size_t patch = 0; patch < views_.size(); ++patch) {
    const auto& [count, lowest, highest] = views_[patch];
    if (count == 0 || highest < begin_pixel || lowest >= end_pixel) continue;
    const int first = layout_->patches[patch].begin;
    for (int i = first; i < first + count; ++i) {
      const int pixel = pixels_[facing_[i]];
      if (pixel >= begin_pixel && pixel < end_pixel) body(facing_[i], pixel);
    }
  }
}

// First pass of a counting sort: the size of each bucket of begin … end. Returns their sum.
int Association::CountBuckets(int begin_pixel, int end_pixel) {
  std::fill(bucket_begin_.begin() + begin_pixel, bucket_begin_.begin() + end_pixel, 0);
  int entries = 0;
  ForEachFacingSlot(begin_pixel, end_pixel, [&](int, int pixel) {
    ++bucket_begin_[pixel];
    ++entries;
  });
  return entries;
}

// Second pass: turns the sizes into ends, then writes the entries, which turns ends into begins.
void Association::SortIntoBuckets(const Surface<float>& surface, int begin_pixel, int end_pixel,
                                  int first_entry) {
  int end = first_entry;
  for (int pixel = begin_pixel; pixel < end_pixel; ++pixel) {
    bucket_begin_[pixel] = end += bucket_begin_[pixel];
  }
  ForEachFacingSlot(begin_pixel, end_pixel, [&](int slot, int pixel) {
    const int at = --bucket_begin_[pixel];
    sorted_.Set(at, surface.posed.At(slot));
    sorted_slots_[at] = slot;
  });
}

void Association::FillBuckets(const Surface<float>& surface, WorkerTeam& team) {
  int lowest = static_cast<int>(bucket_begin_.size()), highest = -1, facing = 0;
  for (const PatchView& view : views_) {
    facing += view.facing;
    if (view.facing == 0) continue;
    lowest = std::min(lowest, view.lowest_pixel);
    highest = std::max(highest, view.highest_pixel);
  }
  first_row_ = lowest / camera_.width;
  last_row_ = highest < 0 ? -1 : highest / camera_.width;
  if (facing == 0) return;
  const int parts = team.threads(), rows = last_row_ + 1 - first_row_;
  const auto first_pixel = [&](int part) {
    return (first_row_ + rows * part / parts) * camera_.width;
  };
  part_entries_.resize(parts);
  team.For(parts, 1, [&](int part, int next) {
    part_entries_[part] = CountBuckets(first_pixel(part), first_pixel(next));
  });
  // The entries of a part follow those of the parts before it.
  std::exclusive_scan(part_entries_.begin(), part_entries_.end(), part_entries_.begin(), 0);
  team.For(parts, 1, [&](int part, int next) {
    SortIntoBuckets(surface, first_pixel(part), first_pixel(next), part_entries_[part]);
  });
  bucket_begin_[static_cast<std::size_t>(last_row_ + 1) * camera_.width] = facing;
}

void Association::FindLongestRays(int window_px) {
  FillRays(camera_.fx, camera_.cx, window_px, column_ray_);
  FillRays(camera_.fy, camera_.cy, window_px, row_ray_);
}

// The columns of one row of pixels hold their vertices side by side. Eight are compared at once
// without branches; the best of the eight lanes is selected at the end.
inline void Association::ScanRow(const Vector3f& point, int row, int first_column, int last_column,
                                 Best& best) const {
  if (row < first_row_ || row > last_row_) return;
  const int at = row * camera_.width;
  const int begin = bucket_begin_[at + std::max(first_column, 0)];
  const int end = bucket_begin_[at + std::min(last_column, camera_.width - 1) + 1];
  constexpr IntLanes kLaneIndex = {0, 1, 2, 3, 4, 5, 6, 7};
  for (int first = begin; first < end; first += kLanes) {
    const FloatLanes dx = LoadLanes<FloatLanes>(sorted_.x, first) - point.x();
    const FloatLanes dy = LoadLanes<FloatLanes>(sorted_.y, first) - point.y();
    const FloatLanes dz = LoadLanes<FloatLanes>(sorted_.z, first) - point.z();
    const auto slots = LoadLanes<IntLanes>(sorted_slots_, first);
    const FloatLanes squared = dx * dx + dy * dy + dz * dz;
    const IntLanes better =
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
  best.squared = FloatLanes{} + limits.cutoff_m * limits.cutoff_m;
  best.slot = IntLanes{} - 1;  // a vertex exactly at the cutoff is not taken
  const auto radius = [&] {
    const float nearest = std::sqrt(SmallestLane(best.squared));
    return static_cast<int>(
        std::min(static_cast<float>(limits.window_px), nearest * px_per_m + 0.5f + kRounding_px));
  };
  // Most points end among the eight pixels round their own.
  const int first = std::min(1, limits.window_px);
  for (int r = row - first; r <= row + first; ++r) {
    ScanRow(point, r, column - first, column + first, best);
  }
  // Without a square root where the answer is no more than that.
  const float enough_m = (static_cast<float>(first) + 0.5f - kRounding_px) / px_per_m;
  const bool is_near = Bits(best.squared < enough_m * enough_m) != 0;
  int reach = is_near ? first : radius();
  for (int m = 0; reach > first && m <= reach; ++m) {
    ScanRow(point, row - m, column - reach, column + reach, best);
    if (m > 0) ScanRow(point, row + m, column - reach, column + reach, best);
    reach = radius();
  }
  // Lanes that found nothing hold the cutoff and −1.
  const float squared = SmallestLane(best.squared);
  return SmallestLane(best.squared == squared ? best.slot
                                              : IntLanes{} + std::numeric_limits<int>::max());
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

void Association::Observe(const PointCloud& cloud, WorkerTeam& team,
                          Observations<float>& observations) const {
  const int parts = team.threads();
  team.For(parts, 1, [&](int part, int next) {
    const int groups = layout_->slot_count() / kLanes;
    const int begin = groups * part / parts * kLanes, end = groups * next / parts * kLanes;
    observations.Clear(begin, end);
    for (std::size_t i = 0; i < nearest_.size(); ++i) {
      const int slot = nearest_[i];
      if (slot >= begin && slot < end) observations.Add(slot, cloud.points[i]);
    }
  });
}

}  // namespace vitruvia::dynamic
