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
constexpr int kTileRowsPerRange = 4;
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
      facing_(layout.slot_count()),
      facing_buckets_(layout.slot_count()),
      facing_moved_m2_(layout.slot_count()),
      arrived_(layout.slot_count()),
      views_(layout.patches.size()),
      tile_boxes_(camera.width, camera.height),
      stride_(camera.width + 1),
      motions_(stride_, camera.height),
      bucket_begin_(static_cast<std::size_t>(stride_) * camera.height, 0),
      tile_row_entries_(camera.height / TileBoxes::kTile_px + 1),
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
  int arrived = 0, facing = begin;
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
    farthest_moved = Max(farthest_moved, usable & had_pixel ? moved : FloatLanes{});
    for (unsigned bits = Bits(usable & ~had_pixel); bits != 0; bits &= bits - 1)
      arrived_[begin + arrived++] = slot + std::countr_zero(bits);
    // Further lanes fall on entries of slots that follow in the patch, or on the slot's own.
    Compress(CountFrom(slot), usable, &facing_[facing]);
    Compress(had_pixel ? moved : FloatLanes{} + kInfinity, usable, &facing_moved_m2_[facing]);
    facing += static_cast<int>(Compress(bucket, usable, &facing_buckets_[facing]));
    StoreLanes(bucket, slot, buckets_);
    StoreLanes(x, slot, projected_.x);
    StoreLanes(y, slot, projected_.y);
    StoreLanes(z, slot, projected_.z);
    buckets.Add(bucket, usable);
    columns.Add(column, usable);
  }
  views_[patch] = {facing - begin,
                   buckets.Lowest(),
                   buckets.Highest(),
                   columns.Lowest(),
                   columns.Highest(),
                   arrived,
                   -SmallestLane(-farthest_moved)};
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

// Each part takes about the same number of slots.
void Association::DividePatches(int parts) {
  if (static_cast<int>(parts_.size()) == parts) return;
  parts_.resize(parts);
  int patch = 0;
  for (int i = 0; i < parts; ++i) {
    parts_[i].entries.assign(bucket_begin_.size(), 0);
    parts_[i].first_patch = patch;
    const std::int64_t end_slot = std::int64_t{layout_->slot_count()} * (i + 1) / parts;
    while (patch < static_cast<int>(views_.size()) && layout_->patches[patch].begin < end_slot)
      ++patch;
    parts_[i].end_patch = patch;
  }
}

// Calls body(slot, bucket, motion) for the facing slots of a part.
template <class Body>
void Association::ForEachFacingSlot(const Part& part, const Body& body) const {
  for (int patch = part.first_patch; patch < part.end_patch; ++patch) {
    const int first = layout_->patches[patch].begin;
    for (int i = first; i < first + views_[patch].facing; ++i)
      body(facing_[i], facing_buckets_[i], facing_moved_m2_[i]);
  }
}

// First pass of a counting sort: the number of a part's slots in each bucket, and their motions.
void Association::CountBuckets(int part) {
  std::vector<int>& entries = parts_[part].entries;
  const int buckets = box_.last_column + 2 - box_.first_column;
  for (int row = box_.first_row; row <= box_.last_row; ++row)
    std::fill_n(&entries[BucketOf(row, box_.first_column)], buckets, 0);
  motions_.Reset(part);
  ForEachFacingSlot(parts_[part], [&](int, int bucket, float moved_m2) {
    ++entries[bucket];
    motions_.Note(part, bucket, moved_m2);
  });
}

// The number of entries of some rows.
int Association::CountTileRow(const PixelRows& rows) const {
  int sum = 0;
  for (const Part& part : parts_) {
    for (int row = rows.begin; row < rows.end; ++row) {
      const auto first = part.entries.begin() + BucketOf(row, box_.first_column);
      sum = std::accumulate(first, first + box_.last_column + 1 - box_.first_column, sum);
    }
  }
  return sum;
}

// Turns the numbers of some rows into ends. In a bucket the first part's entries are the last.
void Association::PlaceBuckets(const PixelRows& rows, int first_entry) {
  int end = first_entry;
  for (int row = rows.begin; row < rows.end; ++row) {
    const int last = BucketOf(row, box_.last_column + 1);
    for (int bucket = BucketOf(row, box_.first_column); bucket <= last; ++bucket) {
      bucket_begin_[bucket] = end;
      for (auto part = parts_.rbegin(); part != parts_.rend(); ++part)
        part->entries[bucket] = end += part->entries[bucket];
    }
  }
}

// Last pass: writes a part's entries.
void Association::SortIntoBuckets(Part& part) {
  ForEachFacingSlot(part, [&](int slot, int bucket, float) {
    const int at = --part.entries[bucket];
    sorted_.Set(at, projected_.At(slot));
    sorted_slots_[at] = slot;
  });
}

Association::PixelRows Association::RowsOfTile(int tile_row) const {
  constexpr int kTile = TileBoxes::kTile_px;
  return {std::max(tile_row * kTile, box_.first_row),
          std::min((tile_row + 1) * kTile, box_.last_row + 1)};
}

// The boxes of the sorted slots of a row of tiles. Whole lanes are read: the next entries may widen
// a box.
void Association::BoundTiles(int tile_row) {
  constexpr int kTile = TileBoxes::kTile_px;
  const PixelRows rows = RowsOfTile(tile_row);
  for (int tile = box_.first_column / kTile; tile <= box_.last_column / kTile; ++tile) {
    const int first_column = std::max(tile * kTile, box_.first_column);
    const int last_column = std::min((tile + 1) * kTile - 1, box_.last_column);
    const FloatLanes infinity = FloatLanes{} + kInfinity;
    PointLanes lower{infinity, infinity, infinity}, upper{-infinity, -infinity, -infinity};
    for (int row = rows.begin; row < rows.end; ++row) {
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

// Sorts the slots of all patches into buckets, one for each pixel. Each thread of the team counts
// and writes those of its share of the patches; between these, the rows of tiles are shared out.
void Association::FillBuckets(WorkerTeam& team) {
  box_ = FindBox();
  CollectArrivals();
  DividePatches(team.threads());
  const int parts = team.threads();
  motions_.Reset(box_, parts);
  team.For(parts, 1, [&](int part, int) { CountBuckets(part); });
  constexpr int kTile = TileBoxes::kTile_px;
  const int first_tile = box_.first_row / kTile;
  const int tile_rows = box_.last_row < 0 ? 0 : box_.last_row / kTile + 1 - first_tile;
  const auto for_tile_rows = [&](const auto& body) {
    team.For(tile_rows, kTileRowsPerRange, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) body(first_tile + i);
    });
  };
  for_tile_rows([&](int i) { tile_row_entries_[i] = CountTileRow(RowsOfTile(i)); });
  const auto entries = tile_row_entries_.begin() + first_tile;
  std::exclusive_scan(entries, entries + tile_rows, entries, 0);
  for_tile_rows([&](int i) {
    const PixelRows rows = RowsOfTile(i);
    PlaceBuckets(rows, tile_row_entries_[i]);
    motions_.Spread(rows.begin, rows.end);
  });
  team.For(parts, 1, [&](int part, int) { SortIntoBuckets(parts_[part]); });
  for_tile_rows([&](int i) { BoundTiles(i); });
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

// The points whose match is one of the slots, without branches, to avoid mispredictions. The lanes
// that no point fills have no match.
Association::PointList Association::PointsOf(int first_point, const SlotRange& slots) const {
  PointList points;
  const int end = std::min(first_point + kPointsPerRange, point_count_);
  for (int i = first_point; i < end; i += kLanes) {
    const auto slot = LoadLanes<IntLanes>(nearest_, i);
    const IntLanes is_one = (slot >= slots.begin) & (slot < slots.end);
    points.count += static_cast<int>(Compress(CountFrom(i), is_one, &points.numbers[points.count]));
  }
  return points;
}

void Association::Observe(WorkerTeam& team, Observations<float>& observations) const {
  const int parts = team.threads();
  team.For(parts, 1, [&](int part, int next) {
    const int groups = layout_->slot_count() / kLanes;
    const int begin = groups * part / parts * kLanes, end = groups * next / parts * kLanes;
    observations.Clear(begin, end);
    for (int first = 0; first < point_count_; first += kPointsPerRange) {
      const PointList points = PointsOf(first, {begin, end});
      for (int k = 0; k < points.count; ++k)
        observations.Add(nearest_[points.numbers[k]], points_.At(points.numbers[k]));
    }
  });
}

}  // namespace vitruvia::dynamic
