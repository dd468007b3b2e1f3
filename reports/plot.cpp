#include "reports/plot.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reports/color_maps.h"

namespace vitruvia {
namespace {

constexpr double kGap = 14.0;                                               // between panels
constexpr double kLeft = 74.0, kRight = 18.0, kTop = 34.0, kBottom = 50.0;  // round a panel's axes
constexpr double kWidePanelHeight = 250.0, kNarrowPanelHeight = 330.0;
constexpr double kLegendLine = 22.0, kLegendSample = 26.0, kLegendSpace = 22.0;
constexpr double kTickLength = 5.0;
constexpr double kFailureRow = 9.0;
constexpr double kHeadroom = 1.06;  // of an axis over its largest value
constexpr Color kGrid{0xe4, 0xe4, 0xe4}, kAxis{0x44, 0x44, 0x44}, kReferenceInk{0x66, 0x66, 0x66};
constexpr double kReferenceDash = 5.0;

// A legend's width must be known before anything can be measured, so widths are taken as this
// many units a letter, a little more than any text needs.
constexpr double kLetterWidth = 7.4;

struct LegendEntry {
  std::string name;
  const Series* sample = nullptr;  // null: the cross of failed frames
  double x = 0.0;
  int line = 0;
};

std::vector<LegendEntry> Legend(const Figure& figure) {
  std::vector<LegendEntry> entries;
  bool failures = false;
  for (const Panel& panel : figure.panels) {
    for (const Series& series : panel.series) {
      failures = failures || !series.failed_x.empty();
      const bool known = std::any_of(entries.begin(), entries.end(),
                                     [&](const auto& e) { return e.name == series.name; });
      if (!known) entries.push_back({series.name, &series});
    }
  }
  if (failures) entries.push_back({"failed frame"});
  double x = kLeft;
  int line = 0;
  for (LegendEntry& entry : entries) {
    const double width = kLegendSample + kLetterWidth * static_cast<double>(entry.name.size());
    if (x + width > kFigureWidth - kRight && x > kLeft) {
      x = kLeft;
      ++line;
    }
    entry.x = x;
    entry.line = line;
    x += width + kLegendSpace;
  }
  return entries;
}

double LegendHeight(const std::vector<LegendEntry>& entries) {
  return entries.empty() ? 0.0 : kLegendLine * (entries.back().line + 1) + 6.0;
}

double PanelHeight(const Figure& figure) {
  return figure.columns == 1 ? kWidePanelHeight : kNarrowPanelHeight;
}

int Rows(const Figure& figure) {
  return (static_cast<int>(figure.panels.size()) + figure.columns - 1) / figure.columns;
}

void DrawLegend(Canvas& canvas, const std::vector<LegendEntry>& entries) {
  for (const LegendEntry& entry : entries) {
    const double y = kLegendLine * (entry.line + 0.5) + 4.0;
    const double middle = entry.x + 0.5 * (kLegendSample - 6.0);
    if (entry.sample == nullptr) {
      canvas.Cross({middle, y}, 3.5, {kFailureColor, 1.6});
    } else if (entry.sample->mark == Mark::kPoints) {
      canvas.Disc({middle, y}, 5.0, entry.sample->color);
    } else {
      canvas.Line({entry.x, y}, {entry.x + kLegendSample - 6.0, y},
                  {entry.sample->color, 2.2, entry.sample->dash});
    }
    canvas.Text({entry.x + kLegendSample, y}, entry.name, {});
  }
}

double LargestFinite(double largest, const std::vector<double>& values) {
  for (const double value : values) {
    if (std::isfinite(value)) largest = std::max(largest, value);
  }
  return largest;
}

double AxisEnd(double fixed, double largest) {
  if (std::isfinite(fixed)) return fixed;
  return largest > 0.0 ? largest * kHeadroom : 1.0;
}

// One panel's mapping from data to page.
class PanelFrame {
 public:
  PanelFrame(const Panel& panel, Point top_left, double width, double height)
      : left_(top_left.x + kLeft),
        top_(top_left.y + kTop),
        width_(width - kLeft - kRight),
        height_(height - kTop - kBottom) {
    double x = 0.0, y = 0.0;
    for (const Series& series : panel.series) {
      x = LargestFinite(LargestFinite(x, series.x), series.x_reach);
      y = LargestFinite(y, series.y);
    }
    for (const Reference& reference : panel.x_references) x = std::max(x, reference.value);
    for (const Reference& reference : panel.y_references) y = std::max(y, reference.value);
    x_end_ = AxisEnd(panel.x_end, x);
    y_end_ = AxisEnd(panel.y_end, y);
  }

  double left() const { return left_; }
  double right() const { return left_ + width_; }
  double top() const { return top_; }
  double bottom() const { return top_ + height_; }
  double x_end() const { return x_end_; }
  double y_end() const { return y_end_; }
  double X(double x) const { return left_ + width_ * x / x_end_; }
  double Y(double y) const { return top_ + height_ * (1.0 - y / y_end_); }
  Point At(double x, double y) const { return {X(x), Y(y)}; }

 private:
  double left_, top_, width_, height_, x_end_ = 1.0, y_end_ = 1.0;
};

void DrawAxes(Canvas& canvas, const Panel& panel, const PanelFrame& frame) {
  const Ticks x_ticks =
      NiceTicks(frame.x_end(), static_cast<int>((frame.right() - frame.left()) / 80));
  const Ticks y_ticks = NiceTicks(frame.y_end(), 5);
  constexpr double kRounding = 1e-9;  // a tick at the very end is still inside
  for (int i = 0; i * x_ticks.step <= frame.x_end() * (1.0 + kRounding); ++i) {
    const double x = frame.X(i * x_ticks.step);
    canvas.Line({x, frame.bottom()}, {x, frame.bottom() + kTickLength}, {kAxis, 1.0});
    canvas.Text({x, frame.bottom() + kTickLength + 2.0},
                fmt::format("{:.{}f}", i * x_ticks.step, x_ticks.decimals),
                {.size = 12.0, .anchor = Anchor::kMiddle, .baseline = Baseline::kTop});
  }
  for (int i = 0; i * y_ticks.step <= frame.y_end() * (1.0 + kRounding); ++i) {
    const double y = frame.Y(i * y_ticks.step);
    if (i > 0) canvas.Line({frame.left(), y}, {frame.right(), y}, {kGrid, 1.0});
    canvas.Text({frame.left() - 7.0, y}, fmt::format("{:.{}f}", i * y_ticks.step, y_ticks.decimals),
                {.size = 12.0, .anchor = Anchor::kEnd});
  }
  canvas.Line({frame.left(), frame.bottom()}, {frame.right(), frame.bottom()}, {kAxis, 1.0});
  canvas.Line({frame.left(), frame.top()}, {frame.left(), frame.bottom()}, {kAxis, 1.0});
  canvas.Text({frame.left(), frame.top() - 12.0}, panel.title, {.size = 14.0, .bold = true});
  canvas.Text({0.5 * (frame.left() + frame.right()), frame.bottom() + 26.0}, panel.x_label,
              {.anchor = Anchor::kMiddle, .baseline = Baseline::kTop});
  canvas.Text({frame.left() - kLeft + 16.0, 0.5 * (frame.top() + frame.bottom())}, panel.y_label,
              {.anchor = Anchor::kMiddle, .direction = Direction::kUpwards});
}

// Lines across, and what they are above the panel, where no curve runs.
void DrawReferences(Canvas& canvas, const Panel& panel, const PanelFrame& frame) {
  const Stroke stroke{kReferenceInk, 1.2, kReferenceDash};
  std::string note;
  for (const Reference& r : panel.y_references) {
    canvas.Line({frame.left(), frame.Y(r.value)}, {frame.right(), frame.Y(r.value)}, stroke);
    note += (note.empty() ? "" : "; ") + r.label;
  }
  for (const Reference& r : panel.x_references) {
    canvas.Line({frame.X(r.value), frame.top()}, {frame.X(r.value), frame.bottom()}, stroke);
    note += (note.empty() ? "" : "; ") + r.label;
  }
  if (note.empty()) return;
  const TextStyle style{.size = 12.0, .color = kReferenceInk, .anchor = Anchor::kEnd};
  const double y = frame.top() - 12.0;
  const double start = frame.right() - canvas.TextWidth(note, style) - 8.0;
  canvas.Text({frame.right(), y}, note, style);
  canvas.Line({start - 22.0, y}, {start, y}, stroke);
}

void DrawLine(Canvas& canvas, const Series& series, const PanelFrame& frame) {
  const Stroke stroke{series.color, 1.8, series.dash};
  std::vector<Point> piece;
  const auto flush = [&] {
    if (piece.size() == 1) canvas.Disc(piece.front(), 1.5, series.color);
    if (piece.size() > 1) canvas.Polyline(piece, stroke);
    piece.clear();
  };
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (std::isfinite(series.x[i]) && std::isfinite(series.y[i])) {
      piece.push_back(frame.At(series.x[i], series.y[i]));
    } else {
      flush();
    }
  }
  flush();
}

void DrawPoints(Canvas& canvas, const Series& series, const PanelFrame& frame) {
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i])) continue;
    const Point at = frame.At(series.x[i], series.y[i]);
    if (!series.x_reach.empty() && std::isfinite(series.x_reach[i])) {
      const double end = frame.X(series.x_reach[i]);
      canvas.Line(at, {end, at.y}, {series.color, 1.6});
      canvas.Line({end, at.y - 5.0}, {end, at.y + 5.0}, {series.color, 1.6});
    }
    canvas.Disc(at, 5.5, series.color);
  }
}

void DrawPanel(Canvas& canvas, const Panel& panel, Point top_left, double width, double height) {
  const PanelFrame frame(panel, top_left, width, height);
  DrawAxes(canvas, panel, frame);
  DrawReferences(canvas, panel, frame);
  bool any = false;
  for (const Series& series : panel.series) any = any || LargestFinite(-1.0, series.y) >= 0.0;
  if (!any) {
    canvas.Text({0.5 * (frame.left() + frame.right()), 0.5 * (frame.top() + frame.bottom())},
                "no data", {.color = kReferenceInk, .anchor = Anchor::kMiddle});
  }
  int failure_row = 0;
  for (const Series& series : panel.series) {
    if (series.mark == Mark::kLine) DrawLine(canvas, series, frame);
    if (series.mark == Mark::kPoints) DrawPoints(canvas, series, frame);
    if (series.failed_x.empty()) continue;
    const double y = frame.top() + kFailureRow * (failure_row++ + 0.5);
    for (const double x : series.failed_x) {
      canvas.Cross({frame.X(x), y}, 3.0, {kFailureColor, 1.4});
    }
  }
}

}  // namespace

Ticks NiceTicks(double end, int count) {
  const double rough = end / std::max(count, 1);
  const double magnitude = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * magnitude;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * magnitude >= rough * (1.0 - 1e-9)) step = factor * magnitude;
  }
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  return {step, decimals};
}

int FigureHeight(const Figure& figure) {
  const int rows = Rows(figure);
  return static_cast<int>(
      std::ceil(LegendHeight(Legend(figure)) + rows * PanelHeight(figure) + (rows - 1) * kGap));
}

void DrawFigure(Canvas& canvas, const Figure& figure) {
  const std::vector<LegendEntry> legend = Legend(figure);
  DrawLegend(canvas, legend);
  const double height = PanelHeight(figure);
  const double width = (kFigureWidth - (figure.columns - 1) * kGap) / figure.columns;
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const int row = static_cast<int>(i) / figure.columns;
    const int column = static_cast<int>(i) % figure.columns;
    DrawPanel(canvas, figure.panels[i],
              {column * (width + kGap), LegendHeight(legend) + row * (height + kGap)}, width,
              height);
  }
}

}  // namespace vitruvia
