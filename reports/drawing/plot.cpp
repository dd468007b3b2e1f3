#include "reports/drawing/plot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/drawing/color_maps.h"

namespace vitruvia {
namespace {

constexpr double kGap = 14.0;  // between panels
constexpr double kLeft = 80.0, kNarrowLeft = 62.0, kRight = 18.0, kTop = 34.0,
                 kBottom = 50.0;  // round a panel's axes
constexpr double kStackedPanelHeight = 250.0, kPanelHeight = 330.0;
constexpr double kLegendLine = 22.0, kLegendSample = 26.0, kLegendSpace = 22.0;
constexpr double kTickLength = 5.0, kTickSpace = 60.0;
constexpr int kYTicks = 5;
constexpr double kLabel = 12.0;  // middle of the y label, from the panel's left
constexpr double kFailureRow = 9.0;
constexpr double kHeadroom = 1.06;  // of an axis over its largest value
constexpr Color kGrid{0xe4, 0xe4, 0xe4}, kAxis{0x44, 0x44, 0x44}, kReferenceInk{0x66, 0x66, 0x66};
constexpr double kReferenceDash = 5.0;
constexpr double kPointRadius = 5.5, kRingWidth = 2.2;
constexpr Color kRingHole{0xff, 0xff, 0xff};

// Fonts differ from reader to reader, so a legend's text is taken to be this wide a letter, a
// little more than it needs.
constexpr double kLetterWidth = 8.0;

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

int Rows(const Figure& figure) {
  return (static_cast<int>(figure.panels.size()) + figure.columns - 1) / figure.columns;
}

double PanelHeight(const Figure& figure) {
  return Rows(figure) > 1 ? kStackedPanelHeight : kPanelHeight;
}

void DrawPoint(Canvas& canvas, Point at, const Series& series) {
  canvas.Disc(at, kPointRadius, series.color);
  if (series.mark == Mark::kRings) canvas.Disc(at, kPointRadius - kRingWidth, kRingHole);
}

void DrawLegend(Canvas& canvas, const std::vector<LegendEntry>& entries) {
  for (const LegendEntry& entry : entries) {
    const double y = kLegendLine * (entry.line + 0.5) + 4.0;
    const double middle = entry.x + 0.5 * (kLegendSample - 6.0);
    if (entry.sample == nullptr) {
      canvas.Cross({middle, y}, 3.5, {kFailureColor, 1.6});
    } else if (entry.sample->mark != Mark::kLine) {
      DrawPoint(canvas, {middle, y}, *entry.sample);
    } else {
      canvas.Line({entry.x, y}, {entry.x + kLegendSample - 6.0, y},
                  {entry.sample->color, 2.2, entry.sample->dash});
    }
    canvas.Text({entry.x + kLegendSample, y}, entry.name, {});
  }
}

// The smallest positive and the largest of what is to be shown.
struct Range {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0.0;

  void Add(double value) {
    if (!std::isfinite(value)) return;
    largest = std::max(largest, value);
    if (value > 0.0) smallest = std::min(smallest, value);
  }
  void Add(const std::vector<double>& values) {
    for (const double value : values) Add(value);
  }
};

Axis MakeAxis(Scale scale, const Range& range, double fixed_end) {
  if (std::isfinite(fixed_end)) return Axis::Linear(fixed_end);
  if (range.largest <= 0.0) return Axis::Linear(1.0);
  if (scale == Scale::kLogarithmic) return Axis::Logarithmic(range.smallest, range.largest);
  return Axis::Linear(range.largest * kHeadroom);
}

Axis MakeXAxis(const Panel& panel) {
  Range range;
  for (const Series& series : panel.series) {
    range.Add(series.x);
    range.Add(series.x_reach);
  }
  for (const Reference& reference : panel.x_references) range.Add(reference.value);
  return MakeAxis(panel.x_scale, range, panel.x_end);
}

Axis MakeYAxis(const Panel& panel) {
  Range range;
  for (const Series& series : panel.series) range.Add(series.y);
  for (const Reference& reference : panel.y_references) range.Add(reference.value);
  return MakeAxis(panel.y_scale, range, panel.y_end);
}

bool HasData(const Panel& panel) {
  for (const Series& series : panel.series) {
    for (const double value : series.y) {
      if (std::isfinite(value)) return true;
    }
  }
  return false;
}

// Narrow panels have short tick labels: they show percent.
double LeftMargin(double panel_width) {
  return panel_width < 0.5 * kFigureWidth ? kNarrowLeft : kLeft;
}

// One panel's mapping from data to page.
class PanelFrame {
 public:
  PanelFrame(const Panel& panel, Point top_left, double width, double height)
      : label_x_(top_left.x + kLabel),
        left_(top_left.x + LeftMargin(width)),
        top_(top_left.y + kTop),
        width_(width - LeftMargin(width) - kRight),
        height_(height - kTop - kBottom),
        x_axis_(MakeXAxis(panel)),
        y_axis_(MakeYAxis(panel)) {}

  double label_x() const { return label_x_; }
  double left() const { return left_; }
  double right() const { return left_ + width_; }
  double top() const { return top_; }
  double bottom() const { return top_ + height_; }
  double X(double x) const { return left_ + width_ * x_axis_.Share(x); }
  double Y(double y) const { return top_ + height_ * (1.0 - y_axis_.Share(y)); }
  Point At(double x, double y) const { return {X(x), Y(y)}; }
  std::vector<Tick> XTicks() const { return x_axis_.Ticks(static_cast<int>(width_ / kTickSpace)); }
  std::vector<Tick> YTicks() const { return y_axis_.Ticks(kYTicks); }

 private:
  double label_x_, left_, top_, width_, height_;
  Axis x_axis_, y_axis_;
};

void DrawAxes(Canvas& canvas, const Panel& panel, const PanelFrame& frame) {
  for (const Tick& tick : frame.XTicks()) {
    const double x = frame.X(tick.value);
    canvas.Line({x, frame.bottom()}, {x, frame.bottom() + kTickLength}, {kAxis, 1.0});
    canvas.Text({x, frame.bottom() + kTickLength + 2.0}, tick.label,
                {.size = 12.0, .anchor = Anchor::kMiddle, .baseline = Baseline::kTop});
  }
  for (const Tick& tick : frame.YTicks()) {
    const double y = frame.Y(tick.value);
    canvas.Line({frame.left(), y}, {frame.right(), y}, {kGrid, 1.0});
    canvas.Text({frame.left() - 7.0, y}, tick.label, {.size = 12.0, .anchor = Anchor::kEnd});
  }
  canvas.Line({frame.left(), frame.bottom()}, {frame.right(), frame.bottom()}, {kAxis, 1.0});
  canvas.Line({frame.left(), frame.top()}, {frame.left(), frame.bottom()}, {kAxis, 1.0});
  canvas.Text({frame.left(), frame.top() - 12.0}, panel.title, {.size = 14.0, .bold = true});
  canvas.Text({0.5 * (frame.left() + frame.right()), frame.bottom() + 26.0}, panel.x_label,
              {.anchor = Anchor::kMiddle, .baseline = Baseline::kTop});
  canvas.Text({frame.label_x(), 0.5 * (frame.top() + frame.bottom())}, panel.y_label,
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
  const double y = frame.top() - 12.0, sample = frame.right() - 22.0;
  canvas.Line({sample, y}, {frame.right(), y}, stroke);
  canvas.Text({sample - 7.0, y}, note,
              {.size = 12.0, .color = kReferenceInk, .anchor = Anchor::kEnd});
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
    DrawPoint(canvas, at, series);
    canvas.Text({at.x + kPointRadius, at.y - kPointRadius - 3.0}, series.label, {.size = 12.0});
  }
}

void DrawPanel(Canvas& canvas, const Panel& panel, Point top_left, double width, double height) {
  const PanelFrame frame(panel, top_left, width, height);
  DrawAxes(canvas, panel, frame);
  DrawReferences(canvas, panel, frame);
  if (!HasData(panel)) {
    canvas.Text({0.5 * (frame.left() + frame.right()), 0.5 * (frame.top() + frame.bottom())},
                "no data", {.color = kReferenceInk, .anchor = Anchor::kMiddle});
  }
  int failure_row = 0;
  for (const Series& series : panel.series) {
    if (series.mark == Mark::kLine) DrawLine(canvas, series, frame);
    if (series.mark != Mark::kLine) DrawPoints(canvas, series, frame);
    if (series.failed_x.empty()) continue;
    const double y = frame.top() + kFailureRow * (failure_row++ + 0.5);
    for (const double x : series.failed_x) {
      canvas.Cross({frame.X(x), y}, 3.0, {kFailureColor, 1.4});
    }
  }
}

}  // namespace

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
