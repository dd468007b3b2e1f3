// The bounding box of the vertices in each tile of the image: a search for the closest vertex
// leaves out the tiles whose boxes are too far away.
#pragma once

#include <array>
#include <vector>

#include "math/lanes.h"
#include "math/vector.h"

namespace vitruvia::dynamic {

// Of columns of pixels, both ends included.
struct ColumnRange {
  int first, last;
};

class TileBoxes {
 public:
  static constexpr int kTile_px = 8;

  TileBoxes(int width_px, int height_px);

  // All vertices with a pixel in the tile lie in the box, lanes together. Tiles that are not set
  // are left as they were. Different tiles may be set on different threads.
  void Set(int tile_row, int tile_column, const PointLanes& lower, const PointLanes& upper);
  // The part of a range of columns outside of which no vertex of a row of tiles is closer to the
  // point.
  ColumnRange Near(int tile_row, const ColumnRange& columns, const Vector3f& point,
                   float distance_m) const;

 private:
  int across_;
  // Per tile, x, y, z, followed by kLanes dummies.
  std::array<std::vector<float>, 3> lower_, upper_;
};

}  // namespace vitruvia::dynamic
