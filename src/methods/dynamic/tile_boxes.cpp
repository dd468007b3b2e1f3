#include "methods/dynamic/tile_boxes.h"

#include <algorithm>
#include <bit>

namespace vitruvia::dynamic {

TileBoxes::TileBoxes(int width_px, int height_px) : across_((width_px + kTile_px - 1) / kTile_px) {
  const int tiles = across_ * ((height_px + kTile_px - 1) / kTile_px);
  for (auto& column : lower_) column.assign(tiles + kLanes, 0.0f);
  for (auto& column : upper_) column.assign(tiles + kLanes, 0.0f);
}

void TileBoxes::Set(int tile_row, int tile_column, const PointLanes& lower,
                    const PointLanes& upper) {
  const int tile = tile_row * across_ + tile_column;
  lower_[0][tile] = SmallestLane(lower.x);
  lower_[1][tile] = SmallestLane(lower.y);
  lower_[2][tile] = SmallestLane(lower.z);
  upper_[0][tile] = -SmallestLane(-upper.x);
  upper_[1][tile] = -SmallestLane(-upper.y);
  upper_[2][tile] = -SmallestLane(-upper.z);
}

ColumnRange TileBoxes::Near(int tile_row, const ColumnRange& columns, const Vector3f& point,
                            float distance_m) const {
  const int last = columns.last / kTile_px;
  ColumnRange near{columns.last + 1, columns.first - 1};
  for (int tile = columns.first / kTile_px; tile <= last; tile += kLanes) {
    FloatLanes squared{};
    for (int axis = 0; axis < 3; ++axis) {
      const int at = tile_row * across_ + tile;
      const FloatLanes below = LoadLanes<FloatLanes>(lower_[axis], at) - point[axis];
      const FloatLanes above = point[axis] - LoadLanes<FloatLanes>(upper_[axis], at);
      const FloatLanes apart = Max(Max(below, above), FloatLanes{});
      squared += apart * apart;
    }
    const int count = std::min(last + 1 - tile, kLanes);
    const unsigned bits = Bits(squared <= distance_m * distance_m) & ((1u << count) - 1u);
    if (bits == 0) continue;
    near.first = std::min(near.first, (tile + std::countr_zero(bits)) * kTile_px);
    near.last = (tile + static_cast<int>(std::bit_width(bits))) * kTile_px - 1;
  }
  return {std::max(near.first, columns.first), std::min(near.last, columns.last)};
}

}  // namespace vitruvia::dynamic
