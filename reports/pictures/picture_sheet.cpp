// All strips of a run on one sheet.
#include <algorithm>

#include <fmt/format.h>

#include "reports/drawing/color_maps.h"
#include "reports/pictures/pictures.h"

namespace vitruvia {
namespace {

constexpr int kCell = 210, kCellGap = 6, kNarrowestMargin = 78, kHeader = 50, kFooter = 70;
constexpr double kLetterWidth = 7.0;  // of a row's label
constexpr int kBarWidth = 3 * kCell / 2, kBarHeight = 12, kBarSteps = 60;

// Room for the rows' labels.
int MarginLeft(const RunPictures& run) {
  std::size_t letters = 0;
  for (const PictureStrip& strip : run.strips) {
    letters = std::max({letters, strip.label.size(), strip.sublabel.size()});
  }
  return std::max(kNarrowestMargin,
                  static_cast<int>(kLetterWidth * static_cast<double>(letters)) + 16);
}

int SheetWidth(const RunPictures& run) {
  return MarginLeft(run) + static_cast<int>(run.titles.size()) * (kCell + kCellGap);
}

void DrawColorBar(Canvas& canvas, Point top_left, Color (*color_of)(double),
                  const std::string& label, const std::vector<std::string>& ticks) {
  for (int i = 0; i < kBarSteps; ++i) {
    const double width = static_cast<double>(kBarWidth) / kBarSteps;
    canvas.Rectangle({top_left.x + i * width, top_left.y}, width + 0.5, kBarHeight,
                     color_of((i + 0.5) / kBarSteps));
  }
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    const double x =
        top_left.x + kBarWidth * static_cast<double>(i) / static_cast<double>(ticks.size() - 1);
    canvas.Text({x, top_left.y + kBarHeight + 4.0}, ticks[i],
                {.size = 12.0, .anchor = Anchor::kMiddle, .baseline = Baseline::kTop});
  }
  canvas.Text({top_left.x, top_left.y - 5.0}, label, {.size = 12.0, .baseline = Baseline::kBottom});
}

// What plain colours mean, a line each.
void DrawKeys(Canvas& canvas, Point top_left, const std::vector<ColorKey>& keys) {
  constexpr double kLine = 20.0;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const double y = top_left.y + static_cast<double>(i) * kLine;
    canvas.Rectangle({top_left.x, y}, kBarHeight, kBarHeight, keys[i].color);
    canvas.Text({top_left.x + kBarHeight + 8.0, y + 0.5 * kBarHeight}, keys[i].meaning,
                {.size = 12.0});
  }
}

// Titles in two lines: what is shown, and from where.
void DrawTitles(Canvas& canvas, const RunPictures& run) {
  const int margin_left = MarginLeft(run);
  for (std::size_t i = 0; i < run.titles.size(); ++i) {
    const std::string& title = run.titles[i];
    const std::size_t comma = title.find(", ");
    const double x = margin_left + static_cast<double>(i) * (kCell + kCellGap) + 0.5 * kCell;
    canvas.Text({x, 16.0}, title.substr(0, comma),
                {.size = 14.0, .anchor = Anchor::kMiddle, .bold = true});
    if (comma == std::string::npos) continue;
    canvas.Text({x, 36.0}, title.substr(comma + 2), {.size = 12.0, .anchor = Anchor::kMiddle});
  }
}

}  // namespace

void WritePictureSheet(DrawingWriter& writer, const std::filesystem::path& stem,
                       const RunPictures& run) {
  const int rows = static_cast<int>(run.strips.size());
  const int margin_left = MarginLeft(run);
  const int height = kHeader + rows * (kCell + kCellGap) + kFooter;
  writer.Write(stem, SheetWidth(run), height, [&](Canvas& canvas) {
    DrawTitles(canvas, run);
    for (int row = 0; row < rows; ++row) {
      const PictureStrip& strip = run.strips[static_cast<std::size_t>(row)];
      const double top = kHeader + row * (kCell + kCellGap);
      canvas.Text({8.0, top + 0.5 * kCell - 9.0}, strip.label, {.size = 12.0, .bold = true});
      canvas.Text({8.0, top + 0.5 * kCell + 9.0}, strip.sublabel, {.size = 12.0});
      for (std::size_t i = 0; i < strip.pictures.size(); ++i) {
        canvas.Picture({margin_left + static_cast<double>(i) * (kCell + kCellGap), top}, kCell,
                       kCell, strip.pictures[i]);
      }
    }
    const double bar_top = height - kFooter + 28.0;
    if (run.farthest_m > 0.0) {
      DrawColorBar(canvas, {margin_left + 10.0, bar_top}, DepthColor, "depth (m)",
                   {fmt::format("{:.1f}", run.nearest_m),
                    fmt::format("{:.2f}", 0.5 * (run.nearest_m + run.farthest_m)),
                    fmt::format("{:.1f}", run.farthest_m)});
    }
    // Beside the bar of the depth, which is not two pictures wide.
    DrawKeys(canvas, {margin_left + 2.0 * (kCell + kCellGap) + 10.0, bar_top - 8.0}, run.keys);
    if (run.error_scale_m == 0.0) return;
    const double error_column = static_cast<double>(run.titles.size()) - 2.0;
    DrawColorBar(canvas, {margin_left + error_column * (kCell + kCellGap) + 10.0, bar_top},
                 ErrorColor, "error (mm)",
                 {"0", fmt::format("{:g}", 500.0 * run.error_scale_m),
                  fmt::format("≥ {:g}", 1000.0 * run.error_scale_m)});
  });
}

}  // namespace vitruvia
