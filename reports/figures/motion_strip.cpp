#include "reports/figures/motion_strip.h"

#include <algorithm>
#include <limits>

namespace vitruvia {
namespace {

constexpr double kPanelWidth = 118.0, kPanelHeight = 150.0, kMargin = 12.0;
constexpr double kTitleHeight = 30.0, kRowTitleHeight = 22.0;
constexpr double kTextSize = 11.0;
constexpr Color kFloorInk{0xBB, 0xBB, 0xBB};

// Heights of a row, and the scale with which its figures fit into the panels.
struct RowExtent {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
  double farthest = 0.0;  // sideways from the center

  void Add(const Vector3<double>& point, const Vector3<double>& center) {
    lowest = std::min(lowest, point.y());
    highest = std::max(highest, point.y());
    farthest =
        std::max({farthest, std::abs(point.x() - center.x()), std::abs(point.z() - center.z())});
  }
  double PixelsPerMetre() const {
    return std::min((kPanelHeight - 2 * kMargin) / std::max(highest - lowest, 1e-3),
                    (kPanelWidth / 2 - 2) / std::max(farthest, 1e-3));
  }
};

RowExtent ExtentOf(const StickFigureRow& row) {
  RowExtent extent;
  for (const StickFigure& figure : row.figures) {
    for (const Stick& stick : figure.sticks) {
      extent.Add(stick.from, figure.center);
      extent.Add(stick.to, figure.center);
    }
  }
  return extent;
}

// `sideways`: the axis that goes to the right, 0 (front view) or 2 (side view).
void DrawFigure(Canvas& canvas, const StickFigure& figure, const RowExtent& extent, int sideways,
                Point top_left) {
  const double scale = extent.PixelsPerMetre();
  const double floor_y = top_left.y + kPanelHeight - kMargin;
  const auto place = [&](const Vector3<double>& p) -> Point {
    return {top_left.x + kPanelWidth / 2 + scale * (p[sideways] - figure.center[sideways]),
            floor_y - scale * (p.y() - extent.lowest)};
  };
  canvas.Line({top_left.x, floor_y}, {top_left.x + kPanelWidth, floor_y}, {kFloorInk, 1.0});
  for (const Stick& stick : figure.sticks) {
    canvas.Line(place(stick.from), place(stick.to), stick.stroke);
  }
}

void DrawRow(Canvas& canvas, const StickFigureRow& row, double top) {
  const RowExtent extent = ExtentOf(row);
  canvas.Text({kMargin, top + kRowTitleHeight / 2}, row.title, {.size = kTextSize, .bold = true});
  for (std::size_t i = 0; i < row.figures.size(); ++i) {
    const Point front{kMargin + kPanelWidth * static_cast<double>(i), top + kRowTitleHeight};
    canvas.Text({front.x + kPanelWidth / 2, front.y + 4}, row.figures[i].label,
                {.size = kTextSize, .anchor = Anchor::kMiddle});
    DrawFigure(canvas, row.figures[i], extent, 0, front);
    DrawFigure(canvas, row.figures[i], extent, 2, {front.x, front.y + kPanelHeight});
  }
}

}  // namespace

void WriteMotionStrip(const std::filesystem::path& stem, const std::string& title,
                      const std::vector<StickFigureRow>& rows) {
  std::size_t columns = 1;
  for (const StickFigureRow& row : rows) columns = std::max(columns, row.figures.size());
  constexpr double kRowHeight = kRowTitleHeight + 2 * kPanelHeight;
  const int width = static_cast<int>(2 * kMargin + kPanelWidth * static_cast<double>(columns));
  const int height =
      static_cast<int>(kTitleHeight + kMargin + kRowHeight * static_cast<double>(rows.size()));
  DrawingWriter().Write(stem, width, height, [&](Canvas& canvas) {
    canvas.Text({kMargin, kTitleHeight / 2}, title, {.bold = true});
    for (std::size_t i = 0; i < rows.size(); ++i) {
      DrawRow(canvas, rows[i], kTitleHeight + kRowHeight * static_cast<double>(i));
    }
  });
}

}  // namespace vitruvia
