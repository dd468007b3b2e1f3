#include "reports/pictures/depth_sheet.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/error.h"
#include "reports/drawing/color_maps.h"
#include "reports/drawing/drawing_writer.h"

namespace vitruvia {
namespace {

constexpr int kColumns = 4;
constexpr double kTileWidth = 240.0, kGap = 6.0, kLine = 20.0;  // page units
constexpr double kScaleWidth = 250.0, kScaleHeight = 12.0;
constexpr int kScaleSteps = 60;
constexpr Color kNothing{0x20, 0x20, 0x20};

struct PersonDepths {
  double nearest_m = std::numeric_limits<double>::infinity(), farthest_m = 0.0;

  double ShareOf(double depth_m) const {
    return std::clamp((depth_m - nearest_m) / std::max(farthest_m - nearest_m, 1e-3), 0.0, 1.0);
  }
};

PersonDepths RangeOf(const std::vector<DepthTile>& tiles) {
  PersonDepths range;
  for (const DepthTile& tile : tiles) {
    for (std::size_t i = 0; i < tile.depth.pixels().size(); ++i) {
      const double z = tile.depth.pixels()[i];
      if (!(z > 0.0) || tile.person.pixels()[i] == 0) continue;
      range.nearest_m = std::min(range.nearest_m, z);
      range.farthest_m = std::max(range.farthest_m, z);
    }
  }
  return range;
}

// Near is bright.
Color Grey(double share) {
  const auto level = static_cast<std::uint8_t>(std::lround(200.0 - 110.0 * share));
  return {level, level, level};
}

ColorImage Colored(const DepthTile& tile, const PersonDepths& range) {
  ColorImage image(tile.depth.width(), tile.depth.height());
  for (std::size_t i = 0; i < image.pixels().size(); ++i) {
    const double z = tile.depth.pixels()[i];
    const double share = range.ShareOf(z);
    const Color color = !(z > 0.0)                    ? kNothing
                        : tile.person.pixels()[i] > 0 ? DepthColor(share)
                                                      : Grey(share);
    image.pixels()[i] = {color[0], color[1], color[2], 255};
  }
  return image;
}

void DrawBar(Canvas& canvas, Point at, const PersonDepths& range) {
  const TextStyle text{.size = 12.0};
  canvas.Text(at, fmt::format("depth of the person: {:.2f} m", range.nearest_m), text);
  at.x += TextWidth("depth of the person: 0.00 m", text) + 8.0;
  for (int i = 0; i < kScaleSteps; ++i) {
    const double width = kScaleWidth / kScaleSteps;
    canvas.Rectangle({at.x + i * width, at.y - 0.5 * kScaleHeight}, width + 0.5, kScaleHeight,
                     DepthColor((i + 0.5) / kScaleSteps));
  }
  canvas.Text({at.x + kScaleWidth + 8.0, at.y},
              fmt::format("{:.2f} m; grey: what else is seen", range.farthest_m), text);
}

}  // namespace

void WriteDepthSheet(const std::filesystem::path& png, const std::vector<DepthTile>& tiles) {
  Require(!tiles.empty(), "WriteDepthSheet: no tiles");
  const PersonDepths range = RangeOf(tiles);
  std::vector<Picture> pictures;
  for (const DepthTile& tile : tiles) pictures.emplace_back(Colored(tile, range));
  const auto count = static_cast<int>(tiles.size());
  const int rows = (count + kColumns - 1) / kColumns;
  const double height = kTileWidth * tiles.front().depth.height() / tiles.front().depth.width();
  const double cell_height = height + kLine + kGap;
  const double width = kGap + kColumns * (kTileWidth + kGap);
  const double bottom = kGap + rows * cell_height;
  std::filesystem::path stem = png;
  const DrawingWriter writer({.png_scale = 1.5, .formats = {FileFormat::kPng}});
  writer.Write(stem.replace_extension(), width, bottom + kLine + kGap, [&](Canvas& canvas) {
    for (int i = 0; i < count; ++i) {
      const int row = i / kColumns, column = i % kColumns;
      const double x = kGap + column * (kTileWidth + kGap);
      const double y = kGap + row * cell_height;
      const auto at = static_cast<std::size_t>(i);
      canvas.Text({x, y + 0.5 * kLine}, tiles[at].label, {.size = 12.0});
      canvas.Image({x, y + kLine}, kTileWidth, height, pictures[at]);
    }
    if (range.farthest_m > 0.0) DrawBar(canvas, {kGap, bottom + 0.5 * kLine}, range);
  });
}

}  // namespace vitruvia
