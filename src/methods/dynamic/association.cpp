#include "methods/dynamic/association.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace vitruvia::dynamic {
namespace {

constexpr float kNearest_m = 0.05f;    // vertices nearer to the camera are not projected
constexpr float kRounding_px = 1e-2f;  // margin of the search for rounding errors
constexpr float kRoundedDown = 1.0f - 1e-5f, kRoundedUp = 1.0f + 1e-5f;
constexpr int kPointsPerRange = 512;  // a multiple of kLanes
constexpr float kInfinity = std::numeric_limits<float>::infinity();

void FillRays(double focal_px, double center_px, int window_px, std::vector<float>& rays) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const double off = std::abs(static_cast<double>(i) - center_px) + window_px + 0.5;
    rays[i] = static_cast<float>(std::hypot(focal_px, off));
  }
}

// The range of those numbers that count.
struct LaneRange {
  IntLanes lowest = IntLanes{} + std::numeric_limits<int>::max(), highest = IntLanes{} - 1;

  void Add(const IntLanes& numbers, const IntLanes& counts) {
    lowest = (counts & (numbers < lowest)) ? numbers : lowest;
    highest = (counts & (numbers > highest)) ? numbers : highest;
  }
  int Lowest() const { return SmallestLane(lowest); }
  int Highest() const { return -SmallestLane(-highest); }
};

int WholeLanes(int count) { return (count + kLanes - 1) / kLanes * kLanes; }

}  // namespace

Association::Association(const PinholeCamera& camera, const SurfaceLayout& layout)
    : camera_(camera),
      layout_(&layout),
      buckets_(layout.slot_count() + kLanes, -1),
      moved_m2_(layout.slot_count(), 0.0f),
      facing_(layout.slot_count()),
      arrived_(layout.slot_count()),
      views_(layout.patches.size()),
      tile_boxes_(camera.width, camera.height),
      stride_(camera.width + 1),
      motions_(stride_, camera.height),
      bucket_begin_(static_cast<std::size_t>(stride_) * camera.height, 0),
      column_ray_(camera.width),
      row_ray_(camera.height) {
  projected_.Resize(layout.slot_count() + kLanes);
  sorted_.Resize(layout.slot_count() + kLanes);
  arrivals_.Resize(layout.slot_count());
  sorted_slots_.resize(layout.slot_count() + kLanes);
  const int most = WholeLanes(camera.width * camera.height);
  for (auto* column : {&points_.x, &points_.y, &points_.z, &bounds_m_, &least_m_})
    column->reserve(most);
  for (auto* column : {&point_buckets_, &nearest_}) column->reserve(most);
  point_pixels_.reserve(most);
}

void Association::SetCloud(const PointCloud& cloud) {
  point_count_ = static_cast<int>(cloud.points.size());
  const int filled_up = WholeLanes(point_count_);
  points_.Resize(filled_up);
  point_pixels_.resize(filled_up);
  point_buckets_.resize(filled_up);
  for (int i = 0; i < point_count_; ++i) {
    const int row = cloud.pixels[i] / camera_.width, column = cloud.pixels[i] % camera_.width;
    points_.Set(i, cloud.points[i]);
    point_pixels_[i] = {column, row};
    point_buckets_[i] = BucketOf(row, column);
  }
  nearest_.assign(filled_up, -1);
  bounds_m_.assign(filled_up, 0.0f);
  least_m_.assign(filled_up, 0.0f);
}

int Association::PixelOf(int slot) const {
  const int bucket = buckets_[slot];
  return bucket < 0 ? -1 : bucket / stride_ * camera_.width + bucket % stride_;
}

void Association::ProjectPatch(int patch, const Surface<float>& surface,
                               const AssociationLimits& limits) {
  const auto fx = static_cast<float>(camera_.fx), fy = static_cast<float>(camera_.fy);
  const auto cx = static_cast<float>(camera_.cx), cy = static_cast<float>(camera_.cy);
  const auto width = static_cast<float>(camera_.width), height = static_cast<float>(camera_.height);
  const float cosine_squared = limits.facing_cosine * limits.facing_cosine;
  const int begin = layout_->patches[patch].begin, end = layout_->patches[patch].end;
  LaneRange buckets, columns;
  FloatLanes farthest_moved{};
  int arrived = 0;
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
    const IntLanes bucket = usable ? row * stride_ + column : IntLanes{} - 1;
    const FloatLanes dx = x - LoadLanes<FloatLanes>(projected_.x, slot),
                     dy = y - LoadLanes<FloatLanes>(projected_.y, slot),
                     dz = z - LoadLanes<FloatLanes>(projected_.z, slot);
    const IntLanes had_pixel = LoadLanes<IntLanes>(buckets_, slot) >= 0;
    const FloatLanes moved = dx * dx + dy * dy + dz * dz;
    StoreLanes(had_pixel ? moved : FloatLanes{} + kInfinity, slot, moved_m2_);
    farthest_moved = Max(farthest_moved, usable & had_pixel ? moved : FloatLanes{});
    for (unsigned bits = Bits(usable & ~had_pixel); bits != 0; bits &= bits - 1)
      arrived_[begin + arrived++] = slot + std::countr_zero(bits);
    StoreLanes(bucket, slot, buckets_);
    StoreLanes(x, slot, projected_.x);
    StoreLanes(y, slot, projected_.y);
    StoreLanes(z, slot, projected_.z);
    buckets.Add(bucket, usable);
    columns.Add(column, usable);
  }
  views_[patch] = {ListFacing(begin, end),
                   buckets.Lowest(),
                   buckets.Highest(),
                   columns.Lowest(),
                   columns.Highest(),
                   arrived,
                   -SmallestLane(-farthest_moved)};
}

// Lists the slots of a patch that have a bucket, without branches, to avoid mispredictions. Returns
// their number.
int Association::ListFacing(int begin, int end) {
  int count = 0;
  for (int slot = begin; slot < end; ++slot) {
    facing_[begin + count] = slot;
    count += buckets_[slot] >= 0 ? 1 : 0;
  }
  return count;
}

PixelBox Association::FindBox() const {
  int lowest = std::numeric_limits<int>::max(), highest = -1;
  PixelBox box;
  box.first_column = camera_.width;
  for (const PatchView& view : views_) {
    if (view.facing == 0) continue;
    lowest = std::min(lowest, view.lowest_bucket);
    highest = std::max(highest, view.highest_bucket);
    box.first_column = std::min(box.first_column, view.lowest_column);
    box.last_column = std::max(box.last_column, view.highest_column);
  }
  if (highest < 0) return {};
  box.first_row = lowest / stride_;
  box.last_row = highest / stride_;
  return box;
}

// What the whole image has of motions and of slots that had no pixel before.
void Association::CollectArrivals() {
  float moved_m2 = 0.0f;
  arrival_count_ = 0;
  for (std::size_t patch = 0; patch < views_.size(); ++patch) {
    const PatchView& view = views_[patch];
    moved_m2 = std::max(moved_m2, view.moved_m2);
    const int first = layout_->patches[patch].begin;
    for (int i = first; i < first + view.arrived; ++i)
      arrivals_.Set(arrival_count_++, projected_.At(arrived_[i]));
  }
  farthest_moved_m_ = kRoundedUp * std::sqrt(moved_m2);
}

// Calls body(slot, bucket) for the facing slots of the rows begin … end, patch after patch.
template <class Body>
void Association::ForEachFacingSlot(int begin_row, int end_row, const Body& body) const {
  const int begin = BucketOf(begin_row, 0), end = BucketOf(end_row, 0);
  for (std::size_t patch = 0; patch < views_.size(); ++patch) {
    const PatchView& view = views_[patch];
    if (view.facing == 0 || view.highest_bucket < begin || view.lowest_bucket >= end) continue;
    const int first = layout_->patches[patch].begin;
    for (int i = first; i < first + view.facing; ++i) {
      const int bucket = buckets_[facing_[i]];
      if (bucket >= begin && bucket < end) body(facing_[i], bucket);
    }
  }
}

// First pass of a counting sort: the size of each bucket of the rows begin … end, and the motions
// of their slots. Returns the number of slots.
int Association::CountBuckets(int begin_row, int end_row) {
  const int buckets = box_.last_column + 2 - box_.first_column;
  for (int row = begin_row; row < end_row; ++row)
    std::fill_n(&bucket_begin_[BucketOf(row, box_.first_column)], buckets, 0);
  int entries = 0;
  ForEachFacingSlot(begin_row, end_row, [&](int slot, int bucket) {
    ++bucket_begin_[bucket];
    ++entries;
    motions_.Note(bucket, moved_m2_[slot]);
  });
  return entries;
}

// Second pass: turns the sizes into ends, then writes the entries, which turns ends into begins.
void Association::SortIntoBuckets(int begin_row, int end_row, int first_entry) {
  int end = first_entry;
  for (int row = begin_row; row < end_row; ++row) {
    const int last = BucketOf(row, box_.last_column + 1);
    for (int bucket = BucketOf(row, box_.first_column); bucket <= last; ++bucket)
      bucket_begin_[bucket] = end += bucket_begin_[bucket];
  }
  ForEachFacingSlot(begin_row, end_row, [&](int slot, int bucket) {
    const int at = --bucket_begin_[bucket];
    sorted_.Set(at, projected_.At(slot));
    sorted_slots_[at] = slot;
  });
}

// The boxes of the sorted slots of the rows begin … end, tile by tile. Whole lanes are read: the
// next entries may widen a box.
void Association::BoundTiles(int begin_row, int end_row) {
  constexpr int kTile = TileBoxes::kTile_px;
  for (int tile_row = begin_row / kTile; tile_row * kTile < end_row; ++tile_row) {
    const int first_row = std::max(tile_row * kTile, begin_row);
    const int last_row = std::min((tile_row + 1) * kTile, end_row) - 1;
    for (int tile = box_.first_column / kTile; tile <= box_.last_column / kTile; ++tile) {
      const int first_column = std::max(tile * kTile, box_.first_column);
      const int last_column = std::min((tile + 1) * kTile - 1, box_.last_column);
      const FloatLanes infinity = FloatLanes{} + kInfinity;
      PointLanes lower{infinity, infinity, infinity}, upper{-infinity, -infinity, -infinity};
      for (int row = first_row; row <= last_row; ++row) {
        const int end = bucket_begin_[BucketOf(row, last_column + 1)];
        for (int at = bucket_begin_[BucketOf(row, first_column)]; at < end; at += kLanes) {
          const auto x = LoadLanes<FloatLanes>(sorted_.x, at);
          const auto y = LoadLanes<FloatLanes>(sorted_.y, at);
          const auto z = LoadLanes<FloatLanes>(sorted_.z, at);
          lower = {Min(lower.x, x), Min(lower.y, y), Min(lower.z, z)};
          upper = {Max(upper.x, x), Max(upper.y, y), Max(upper.z, z)};
        }
      }
      tile_boxes_.Set(tile_row, tile, lower, upper);
    }
  }
}

// Sorts the slots of all patches into buckets, one for each pixel. Each thread of the team fills
// those of its share of the rows, whole tiles.
void Association::FillBuckets(WorkerTeam& team) {
  box_ = FindBox();
  CollectArrivals();
  motions_.Reset(box_);
  constexpr int kTile = TileBoxes::kTile_px;
  const int parts = team.threads();
  const int first_tile = box_.first_row / kTile, tiles = box_.last_row / kTile + 1 - first_tile;
  const auto first_row = [&](int part) {
    return std::clamp((first_tile + tiles * part / parts) * kTile, box_.first_row,
                      box_.last_row + 1);
  };
  part_entries_.resize(parts);
  team.For(parts, 1, [&](int part, int next) {
    part_entries_[part] = CountBuckets(first_row(part), first_row(next));
  });
  // The entries of a part follow those of the parts before it.
  std::exclusive_scan(part_entries_.begin(), part_entries_.end(), part_entries_.begin(), 0);
  team.For(parts, 1, [&](int part, int next) {
    SortIntoBuckets(first_row(part), first_row(next), part_entries_[part]);
  });
  team.For(parts, 1, [&](int part, int next) { BoundTiles(first_row(part), first_row(next)); });
  motions_.Spread();
}

// Bounds hold for one window: a match may be outside of a smaller one.
void Association::SetWindow(int window_px) {
  if (window_px == window_px_) return;
  window_px_ = window_px;
  FillRays(camera_.fx, camera_.cx, window_px, column_ray_);
  FillRays(camera_.fy, camera_.cy, window_px, row_ray_);
  std::fill(bounds_m_.begin(), bounds_m_.end(), 0.0f);
  std::fill(least_m_.begin(), least_m_.end(), 0.0f);
}

// The columns of one row of pixels hold their vertices side by side. Eight are compared at once
// without branches; the best of the eight lanes is selected at the end.
inline void Association::ScanRow(const Vector3f& point, int row, const ColumnRange& columns,
                                 Best& best) const {
  if (row < box_.first_row || row > box_.last_row) return;
  const int first_column = std::max(columns.first, box_.first_column);
  const int last_column = std::min(columns.last, box_.last_column);
  if (first_column > last_column) return;
  const int begin = bucket_begin_[BucketOf(row, first_column)];
  const int end = bucket_begin_[BucketOf(row, last_column + 1)];
  const IntLanes lane_index = CountFrom(0);
  for (int first = begin; first < end; first += kLanes) {
    const FloatLanes dx = LoadLanes<FloatLanes>(sorted_.x, first) - point.x();
    const FloatLanes dy = LoadLanes<FloatLanes>(sorted_.y, first) - point.y();
    const FloatLanes dz = LoadLanes<FloatLanes>(sorted_.z, first) - point.z();
    const auto slots = LoadLanes<IntLanes>(sorted_slots_, first);
    const FloatLanes squared =
        lane_index < end - first ? dx * dx + dy * dy + dz * dz : FloatLanes{} + kInfinity;
    const IntLanes better =
        (squared < best.squared) | ((squared == best.squared) & (slots < best.slot));
    best.second = Min(best.second, Max(best.squared, squared));
    best.squared = better ? squared : best.squared;
    best.slot = better ? slots : best.slot;
  }
}

// A vertex whose pixel is m columns (or rows) from the point's lies beyond the plane through the
// camera at m − ½ columns, so at least z (m − ½) / |(u − cx, fx)| from the point. Returns that
// distance for the pixels that are not among the `pixels` next columns and rows to each side.
float Association::NearestBeyond(int i, int pixels) const {
  const auto [column, row] = point_pixels_[i];
  return (static_cast<float>(pixels) + 0.5f - kRounding_px) * points_.z[i] /
         std::max(column_ray_[column], row_ray_[row]);
}
// The other way round: vertices of pixels farther away are not closer than this.
int Association::ReachOf(int i, float distance_m) const {
  const auto [column, row] = point_pixels_[i];
  const float px_per_m = std::max(column_ray_[column], row_ray_[row]) / points_.z[i];
  return static_cast<int>(
      std::min(static_cast<float>(window_px_), distance_m * px_per_m + 0.5f + kRounding_px));
}

// Of the match before; ∞ if it has no pixel in the window any more.
float Association::SquaredDistanceOfMatch(int i) const {
  const int slot = nearest_[i];
  if (slot < 0 || buckets_[slot] < 0) return kInfinity;
  const float squared = (projected_.At(slot) - points_.At(i)).squaredNorm();
  const float in_window_m = NearestBeyond(i, window_px_);
  return squared < in_window_m * in_window_m ? squared : kInfinity;
}

// Most searches end among the eight pixels round the point's own.
Association::Match Association::Search(int i, float cutoff_m) const {
  const auto [column, row] = point_pixels_[i];
  const Vector3f point = points_.At(i);
  // A vertex exactly at the cutoff is not taken.
  const Best none{FloatLanes{} + cutoff_m * cutoff_m, IntLanes{} - 1, FloatLanes{} + kInfinity};
  Best best = none;
  const int reach = std::min(1, window_px_);
  const float enough_m = NearestBeyond(i, reach);
  for (int r = row - reach; r <= row + reach; ++r)
    ScanRow(point, r, {column - reach, column + reach}, best);
  if (Bits(best.squared < enough_m * enough_m) == 0) {
    const float upper_m2 = std::min(SmallestLane(best.squared), SquaredDistanceOfMatch(i));
    best = none;
    SearchFarther(i, std::sqrt(upper_m2), best);
  }
  // Lanes that found nothing hold the cutoff and −1.
  const float squared = SmallestLane(best.squared);
  const int slot = SmallestLane(
      best.squared == squared ? best.slot : IntLanes{} + std::numeric_limits<int>::max());
  // The others: the second of the match's lane and the best ones of the other lanes, and vertices
  // farther than the pixels whose motions are known.
  const float other_m = std::sqrt(SmallestLane(best.slot == slot ? best.second : best.squared));
  const float least_m = std::min(std::sqrt(squared), NearestBeyond(i, window_px_));
  return {slot, kRoundedDown * std::min(other_m, enough_m), kRoundedDown * least_m};
}

// Searches where vertices may be as close as the closest one so far, from the point's rows outward.
// It is known that one, or the cutoff, is as close as nearest_m, and none as close as enough_m, so
// that tiles may be left out: the bound of the others is not larger than enough_m.
void Association::SearchFarther(int i, float nearest_m, Best& best) const {
  const int column = point_pixels_[i].column, row = point_pixels_[i].row;
  const Vector3f point = points_.At(i);
  int reach = ReachOf(i, nearest_m);
  constexpr int kTile = TileBoxes::kTile_px;
  const auto scan = [&](int tile_row) {
    const int first_row = std::max({tile_row * kTile, row - reach, box_.first_row});
    const int last_row = std::min({(tile_row + 1) * kTile - 1, row + reach, box_.last_row});
    const ColumnRange window{std::max(column - reach, box_.first_column),
                             std::min(column + reach, box_.last_column)};
    if (first_row > last_row || window.first > window.last) return;
    const ColumnRange columns = tile_boxes_.Near(tile_row, window, point, kRoundedUp * nearest_m);
    if (columns.first > columns.last) return;
    for (int r = first_row; r <= last_row; ++r) ScanRow(point, r, columns, best);
    nearest_m = std::min(nearest_m, std::sqrt(SmallestLane(best.squared)));
    reach = std::min(reach, ReachOf(i, nearest_m));
  };
  const int middle = row / kTile;
  scan(middle);
  for (int m = 1; (m - 1) * kTile < reach; ++m) {
    scan(middle - m);
    scan(middle + m);
  }
}

// Lets eight points go on without a search where their bounds allow it. Returns a bit for each of
// the others.
unsigned Association::KeepProven(int first_point, float cutoff_m) {
  const auto slots = LoadLanes<IntLanes>(nearest_, first_point);
  FloatLanes x{}, y{}, z{}, motion{};
  IntLanes bucket{};
  for (int lane = 0; lane < kLanes; ++lane) {
    const int slot = std::max(slots[lane], 0);
    x[lane] = projected_.x[slot];
    y[lane] = projected_.y[slot];
    z[lane] = projected_.z[slot];
    bucket[lane] = buckets_[slot];
    motion[lane] = motions_.Near(point_buckets_[first_point + lane]);
  }
  const FloatLanes dx = x - LoadLanes<FloatLanes>(points_.x, first_point);
  const FloatLanes dy = y - LoadLanes<FloatLanes>(points_.y, first_point);
  const FloatLanes dz = z - LoadLanes<FloatLanes>(points_.z, first_point);
  const FloatLanes squared = dx * dx + dy * dy + dz * dz;
  const FloatLanes bound =
      Max(LoadLanes<FloatLanes>(bounds_m_, first_point) - kRoundedUp * Sqrt(motion), FloatLanes{});
  const float cutoff_squared = cutoff_m * cutoff_m;
  const IntLanes is_near = (slots >= 0) & (bucket >= 0) & (squared < cutoff_squared);
  const IntLanes stays = is_near & (squared < bound * bound);
  const FloatLanes cutoff = FloatLanes{} + cutoff_m;
  const FloatLanes least = LeastDistances(first_point, ~stays, cutoff_m);
  const IntLanes finds_none = ~is_near & ((bound >= cutoff) | (least >= cutoff));
  // A match that is lost here becomes one of the others, at the cutoff or farther.
  StoreLanes(finds_none ? Min(bound, cutoff) : bound, first_point, bounds_m_);
  StoreLanes(least, first_point, least_m_);
  StoreLanes(finds_none ? IntLanes{} - 1 : slots, first_point, nearest_);
  return Bits(~(stays | finds_none));
}

// Of eight points: no vertex at all is closer. Found where it may show that there is no match, else
// 0.
FloatLanes Association::LeastDistances(int first_point, const IntLanes& is_asked,
                                       float cutoff_m) const {
  const FloatLanes moved_less = LoadLanes<FloatLanes>(least_m_, first_point) - farthest_moved_m_;
  if (Bits(is_asked & (moved_less >= cutoff_m)) == 0) return FloatLanes{};
  FloatLanes arrival = FloatLanes{} + kInfinity;
  const auto x = LoadLanes<FloatLanes>(points_.x, first_point);
  const auto y = LoadLanes<FloatLanes>(points_.y, first_point);
  const auto z = LoadLanes<FloatLanes>(points_.z, first_point);
  for (int k = 0; k < arrival_count_; ++k) {
    const FloatLanes dx = x - arrivals_.x[k], dy = y - arrivals_.y[k], dz = z - arrivals_.z[k];
    arrival = Min(arrival, dx * dx + dy * dy + dz * dz);
  }
  return Min(moved_less, kRoundedDown * Sqrt(arrival));
}

void Association::FindNearest(const AssociationLimits& limits, WorkerTeam& team) {
  SetWindow(limits.window_px);
  FillBuckets(team);
  std::atomic<int> searched{0};
  team.For(point_count_, kPointsPerRange,
           [&](int begin, int end) { searched += FindNearestOf(begin, end, limits.cutoff_m); });
  searched_ = searched;
}

// Of the points begin … end. Returns the number of searches.
int Association::FindNearestOf(int begin, int end, float cutoff_m) {
  std::array<int, kPointsPerRange> unproven;  // a list, so that searches follow without a branch
  int count = 0;
  for (int first = begin; first < end; first += kLanes) {
    const unsigned points = (1u << std::min(end - first, kLanes)) - 1u;
    for (unsigned left = points & KeepProven(first, cutoff_m); left != 0; left &= left - 1)
      unproven[count++] = first + std::countr_zero(left);
  }
  for (int k = 0; k < count; ++k) {
    const int i = unproven[k];
    const Match match = Search(i, cutoff_m);
    nearest_[i] = match.slot;
    bounds_m_[i] = match.bound_m;
    least_m_[i] = match.least_m;
  }
  return count;
}

void Association::Observe(WorkerTeam& team, Observations<float>& observations) const {
  const int parts = team.threads();
  team.For(parts, 1, [&](int part, int next) {
    const int groups = layout_->slot_count() / kLanes;
    const int begin = groups * part / parts * kLanes, end = groups * next / parts * kLanes;
    observations.Clear(begin, end);
    for (int i = 0; i < point_count_; ++i) {
      const int slot = nearest_[i];
      if (slot >= begin && slot < end) observations.Add(slot, points_.At(i));
    }
  });
}

}  // namespace vitruvia::dynamic
