#include "reports/drawing/plot.h"

#include <algorithm>
#include <cmath>

#include "reports/drawing/color_maps.h"
#include "reports/drawing/legend.h"

namespace vitruvia {
namespace {

// Lengths in units of the usual style; a style with other text scales them all.
constexpr double kUsualText = 13.0;
constexpr double kGap = 14.0;  // between panels
constexpr double kNarrowestPanel = 180.0;
constexpr double kPanelHeight = 330.0, kStackedPanelHeight = 250.0;
constexpr double kTallest = 0.75;  // of a panel's axes, as a share of its width
constexpr double kMargin = 6.0, kTickLength = 5.0, kTickSpace = 60.0, kTextLine = 15.0;
constexpr double kRowHeight = 22.0;    // of rows of bars
constexpr double kWidestNames = 0.42;  // of names beside an axis, as a share of the panel
constexpr int kYTicks = 5;
constexpr double kTickText = 12.0, kTitleText = 14.0;
constexpr double kFailureRow = 9.0;
constexpr double kHeadroom = 1.06;  // of an axis over its largest value
// An axis begins at 0 unless all values lie above this share of the largest.
constexpr double kFarFromZero = 0.7;
constexpr Color kGrid{0xe4, 0xe4, 0xe4}, kAxis{0x44, 0x44, 0x44}, kReferenceInk{0x66, 0x66, 0x66};
constexpr double kReferenceDash = 5.0;
constexpr double kBandOpacity = 0.2;

// The smallest, the smallest positive and the largest of what is to be shown.
struct Range {
  double least = std::numeric_limits<double>::infinity();
  double least_positive = std::numeric_limits<double>::infinity();
  double largest = -std::numeric_limits<double>::infinity();

  void Add(double value) {
    if (!std::isfinite(value)) return;
    least = std::min(least, value);
    largest = std::max(largest, value);
    if (value > 0.0) least_positive = std::min(least_positive, value);
  }
  void Add(const std::vector<double>& values) {
    for (const double value : values) Add(value);
  }
  void Add(const std::vector<Reference>& references) {
    for (const Reference& reference : references) {
      if (reference.stretches_axis) Add(reference.value);
    }
  }
};

Axis LinearAxis(const Range& range) {
  const double top = range.largest + (kHeadroom - 1.0) * std::abs(range.largest);
  if (range.least < 0.0) return Axis::Linear(kHeadroom * range.least, std::max(top, 0.0));
  if (range.least < kFarFromZero * range.largest || range.least == range.largest)
    return Axis::Linear(0.0, top);
  const double headroom = 0.1 * (range.largest - range.least);
  return Axis::Linear(range.least - headroom, range.largest + headroom);
}

Axis MakeAxis(Scale scale, const Range& range, double fixed_end) {
  if (std::isfinite(fixed_end)) return Axis::Linear(0.0, fixed_end);
  const bool empty = range.largest < range.least;
  if (empty || (range.largest == 0.0 && range.least == 0.0)) return Axis::Linear(0.0, 1.0);
  if (scale == Scale::kLogarithmic && std::isfinite(range.least_positive))
    return Axis::Logarithmic(range.least_positive, range.largest);
  return LinearAxis(range);
}

// Of ticks with names: half a step beyond the first and the last.
Axis AxisOfNames(std::size_t count) { return Axis::Linear(-0.5, static_cast<double>(count) - 0.5); }

std::vector<double> StackedEnds(const Panel& panel) {
  std::vector<double> ends(panel.y_ticks.size(), 0.0);
  for (const Series& series : panel.series) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (std::isfinite(series.x[i])) ends[i] += series.x[i];
    }
  }
  return ends;
}

bool HasBars(const Panel& panel) {
  return !panel.series.empty() && panel.series.front().mark == Mark::kStackedBars;
}

Axis MakeXAxis(const Panel& panel) {
  if (!panel.x_ticks.empty()) return AxisOfNames(panel.x_ticks.size());
  Range range;
  if (HasBars(panel)) {
    range.Add(0.0);
    range.Add(StackedEnds(panel));
  } else {
    for (const Series& series : panel.series) {
      range.Add(series.x);
      range.Add(series.x_reach);
    }
  }
  range.Add(panel.x_references);
  return MakeAxis(panel.x_scale, range, panel.x_end);
}

Axis MakeYAxis(const Panel& panel) {
  if (!panel.y_ticks.empty()) return AxisOfNames(panel.y_ticks.size());
  Range range;
  for (const Series& series : panel.series) {
    range.Add(series.y);
    range.Add(series.y_low);
    range.Add(series.y_high);
  }
  range.Add(panel.y_references);
  return MakeAxis(panel.y_scale, range, panel.y_end);
}

bool HasData(const Panel& panel) {
  if (panel.cells) return true;
  return std::any_of(panel.series.begin(), panel.series.end(), [](const Series& series) {
    return std::any_of(series.y.begin(), series.y.end(), [](double y) { return std::isfinite(y); });
  });
}

// Styles of one figure's texts.
struct Texts {
  explicit Texts(const FigureStyle& style) : scale(style.text_size / kUsualText) {}

  TextStyle Label() const { return {.size = scale * kUsualText}; }
  TextStyle Title() const { return {.size = scale * kTitleText, .bold = true}; }
  TextStyle TickText() const { return {.size = scale * kTickText}; }
  double Line() const { return scale * kTextLine; }

  double scale;
};

// What stands above a panel on the right: the references' names.
std::string ReferenceNote(const Panel& panel) {
  std::string note;
  for (const auto* references : {&panel.y_references, &panel.x_references}) {
    const Axis axis = references == &panel.y_references ? MakeYAxis(panel) : MakeXAxis(panel);
    for (const Reference& r : *references) {
      note += (note.empty() ? "" : "; ") + r.label;
      if (!axis.Holds(r.value)) note += " (beyond the axis)";
    }
  }
  return note;
}

// Room round the axes, the same for all panels of a figure.
struct Margins {
  double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0;
};

double WidestTick(const std::vector<Tick>& ticks, const TextStyle& style) {
  double widest = 0.0;
  for (const Tick& tick : ticks) widest = std::max(widest, TextWidth(tick.label, style));
  return widest;
}

std::vector<Tick> YTicks(const Panel& panel) {
  return panel.y_ticks.empty() ? MakeYAxis(panel).Ticks(kYTicks) : panel.y_ticks;
}

// Title, and the names of references below it.
std::size_t HeadLines(const Panel& panel, double width, const Texts& texts) {
  const std::string note = ReferenceNote(panel);
  return WrappedText(panel.title, width, texts.Title()).size() +
         WrappedText(note, width - 30.0 * texts.scale, texts.TickText()).size();
}

Margins MarginsOf(const Panel& panel, double width, double height, const Texts& texts) {
  const double u = texts.scale;
  Margins m;
  const std::size_t y_lines = WrappedText(panel.y_label, 0.8 * height, texts.Label()).size();
  m.left = kMargin * u + static_cast<double>(y_lines) * texts.Line() + 11.0 * u +
           std::min(WidestTick(YTicks(panel), texts.TickText()), kWidestNames * width);
  m.right = 18.0 * u;
  const double inner = width - m.left - m.right;
  m.top = 12.0 * u + static_cast<double>(HeadLines(panel, inner, texts)) * texts.Line() * 1.1;
  const std::size_t x_lines = WrappedText(panel.x_label, inner, texts.Label()).size();
  m.bottom = 27.0 * u + static_cast<double>(x_lines) * texts.Line();
  return m;
}

int ColumnsOf(const Figure& figure, const FigureStyle& style) {
  const double narrowest = kNarrowestPanel * style.text_size / kUsualText;
  const int most = std::min(figure.columns, static_cast<int>(figure.panels.size()));
  return std::clamp(static_cast<int>(style.width / narrowest), 1, std::max(most, 1));
}

// The most lines that a name beside an axis needs.
std::size_t LinesOfNames(const Panel& panel, double width, const Texts& texts) {
  std::size_t most = 1;
  for (const Tick& tick : panel.y_ticks)
    most = std::max(most, WrappedText(tick.label, width, texts.TickText()).size());
  return most;
}

// How high the axes of a panel are. Rows of bars and of cells have a height of their own, in which
// their names have room.
double AxesHeight(const Figure& figure, double usual_panel, double panel_width,
                  const Texts& texts) {
  double height = 0.0;
  for (const Panel& panel : figure.panels) {
    const std::size_t lines = LinesOfNames(panel, kWidestNames * panel_width, texts);
    const double row =
        std::max(kRowHeight * texts.scale, (static_cast<double>(lines) + 0.5) * texts.Line());
    height = std::max(height, row * static_cast<double>(panel.y_ticks.size()));
  }
  if (height > 0.0) return std::max(height, 2.0 * kRowHeight * texts.scale);
  return std::min(usual_panel - 84.0 * texts.scale, kTallest * panel_width);
}

struct Layout {
  Layout(const Figure& figure, const FigureStyle& style)
      : texts(style),
        legend(figure, style.width, texts.scale),
        gap(kGap * texts.scale),
        columns(ColumnsOf(figure, style)),
        rows((static_cast<int>(figure.panels.size()) + columns - 1) / columns),
        panel_width((style.width - (columns - 1) * gap) / columns) {
    const double usual = texts.scale * (rows > 1 ? kStackedPanelHeight : kPanelHeight);
    for (const Panel& panel : figure.panels) {
      const Margins m = MarginsOf(panel, panel_width, usual, texts);
      margins = {std::max(margins.left, m.left), std::max(margins.right, m.right),
                 std::max(margins.top, m.top), std::max(margins.bottom, m.bottom)};
    }
    panel_height = margins.top + margins.bottom + AxesHeight(figure, usual, panel_width, texts);
  }

  double Height() const {
    return legend.height() + rows * panel_height + std::max(rows - 1, 0) * gap;
  }
  Point TopLeft(std::size_t panel) const {
    const int row = static_cast<int>(panel) / columns, column = static_cast<int>(panel) % columns;
    return {column * (panel_width + gap), legend.height() + row * (panel_height + gap)};
  }

  Texts texts;
  Legend legend;
  double gap;
  int columns, rows;
  double panel_width, panel_height = 0.0;
  Margins margins;  // of every panel, so that their axes line up
};

// One panel's mapping from data to page.
class PanelFrame {
 public:
  PanelFrame(const Panel& panel, Point top_left, const Layout& layout)
      : texts(layout.texts),
        panel_left(top_left.x),
        panel_top(top_left.y),
        left(top_left.x + layout.margins.left),
        right(top_left.x + layout.panel_width - layout.margins.right),
        top(top_left.y + layout.margins.top),
        bottom(top_left.y + layout.panel_height - layout.margins.bottom),
        x_axis(MakeXAxis(panel)),
        y_axis(MakeYAxis(panel)) {}

  double X(double x) const { return left + (right - left) * x_axis.Share(x); }
  double Y(double y) const { return bottom - (bottom - top) * y_axis.Share(y); }
  Point At(double x, double y) const { return {X(x), Y(y)}; }

  Texts texts;
  double panel_left, panel_top, left, right, top, bottom;
  Axis x_axis, y_axis;
};

std::vector<Tick> XTicks(const Panel& panel, const PanelFrame& frame) {
  if (!panel.x_ticks.empty()) return panel.x_ticks;
  return frame.x_axis.Ticks(
      static_cast<int>((frame.right - frame.left) / (kTickSpace * frame.texts.scale)));
}

void DrawLines(Canvas& canvas, Point at, const std::vector<std::string>& lines,
               const TextStyle& style, double distance) {
  for (const std::string& line : lines) {
    canvas.Text(at, line, style);
    (style.direction == Direction::kUpwards ? at.x : at.y) += distance;
  }
}

void DrawXTicks(Canvas& canvas, const Panel& panel, const PanelFrame& frame) {
  const double u = frame.texts.scale;
  TextStyle style = frame.texts.TickText();
  style.anchor = Anchor::kMiddle;
  style.baseline = Baseline::kTop;
  double free_from = -std::numeric_limits<double>::infinity();  // of the labels so far
  for (const Tick& tick : XTicks(panel, frame)) {
    const double x = frame.X(tick.value), half = 0.5 * TextWidth(tick.label, style);
    canvas.Line({x, frame.bottom}, {x, frame.bottom + kTickLength * u}, {kAxis, u});
    if (x - half < free_from) continue;
    free_from = x + half + 4.0 * u;
    canvas.Text({x, frame.bottom + (kTickLength + 2.0) * u}, tick.label, style);
  }
}

void DrawYTicks(Canvas& canvas, const Panel& panel, const PanelFrame& frame, double name_width) {
  const double u = frame.texts.scale;
  TextStyle style = frame.texts.TickText();
  style.anchor = Anchor::kEnd;
  for (const Tick& tick : YTicks(panel)) {
    const double y = frame.Y(tick.value);
    if (panel.y_ticks.empty()) canvas.Line({frame.left, y}, {frame.right, y}, {kGrid, u});
    const std::vector<std::string> lines = WrappedText(tick.label, name_width, style);
    const double first = y - 0.5 * static_cast<double>(lines.size() - 1) * frame.texts.Line();
    DrawLines(canvas, {frame.left - 7.0 * u, first}, lines, style, frame.texts.Line());
  }
}

void DrawLabels(Canvas& canvas, const Panel& panel, const PanelFrame& frame) {
  const double u = frame.texts.scale, line = frame.texts.Line();
  TextStyle style = frame.texts.Label();
  style.anchor = Anchor::kMiddle;
  style.baseline = Baseline::kTop;
  DrawLines(canvas, {0.5 * (frame.left + frame.right), frame.bottom + 23.0 * u},
            WrappedText(panel.x_label, frame.right - frame.left, style), style, line);
  style.direction = Direction::kUpwards;
  style.baseline = Baseline::kMiddle;
  DrawLines(canvas, {frame.panel_left + kMargin * u + 0.5 * line, 0.5 * (frame.top + frame.bottom)},
            WrappedText(panel.y_label, frame.bottom - frame.top, style), style, line);
}

void DrawAxes(Canvas& canvas, const Panel& panel, const PanelFrame& frame) {
  const double u = frame.texts.scale;
  DrawYTicks(canvas, panel, frame,
             frame.left - frame.panel_left - (kMargin + 11.0) * u - frame.texts.Line());
  DrawXTicks(canvas, panel, frame);
  canvas.Line({frame.left, frame.bottom}, {frame.right, frame.bottom}, {kAxis, u});
  canvas.Line({frame.left, frame.top}, {frame.left, frame.bottom}, {kAxis, u});
  DrawLabels(canvas, panel, frame);
}

// The title, and what the dashed lines are, above the panel, where no curve runs.
void DrawHead(Canvas& canvas, const Panel& panel, const PanelFrame& frame) {
  const double u = frame.texts.scale, line = 1.1 * frame.texts.Line();
  const double width = frame.right - frame.left;
  const TextStyle title_style = frame.texts.Title();
  TextStyle note_style = frame.texts.TickText();
  note_style.color = kReferenceInk;
  const auto title = WrappedText(panel.title, width, title_style);
  const auto note = WrappedText(ReferenceNote(panel), width - 30.0 * u, note_style);
  const double lines = static_cast<double>(title.size() + note.size());
  const double first = frame.top - 8.0 * u - (lines - 0.5) * line;
  DrawLines(canvas, {frame.left, first}, title, title_style, line);
  if (note.empty()) return;
  const double y = first + static_cast<double>(title.size()) * line;
  canvas.Line({frame.left, y}, {frame.left + 22.0 * u, y},
              {kReferenceInk, 1.2 * u, kReferenceDash * u});
  DrawLines(canvas, {frame.left + 28.0 * u, y}, note, note_style, line);
}

void DrawReferences(Canvas& canvas, const Panel& panel, const PanelFrame& frame) {
  const double u = frame.texts.scale;
  const Stroke stroke{kReferenceInk, 1.2 * u, kReferenceDash * u};
  for (const Reference& r : panel.y_references) {
    if (!frame.y_axis.Holds(r.value)) continue;
    canvas.Line({frame.left, frame.Y(r.value)}, {frame.right, frame.Y(r.value)}, stroke);
  }
  for (const Reference& r : panel.x_references) {
    if (!frame.x_axis.Holds(r.value)) continue;
    canvas.Line({frame.X(r.value), frame.top}, {frame.X(r.value), frame.bottom}, stroke);
  }
}

// Runs of points without a gap.
std::vector<std::pair<std::size_t, std::size_t>> Pieces(const Series& series) {
  std::vector<std::pair<std::size_t, std::size_t>> pieces;
  std::size_t first = 0;
  for (std::size_t i = 0; i <= series.x.size(); ++i) {
    const bool here =
        i < series.x.size() && std::isfinite(series.x[i]) && std::isfinite(series.y[i]);
    if (here) continue;
    if (i > first) pieces.emplace_back(first, i);
    first = i + 1;
  }
  return pieces;
}

void DrawBand(Canvas& canvas, const Series& series, const PanelFrame& frame) {
  if (series.y_low.empty()) return;
  for (const auto& [first, last] : Pieces(series)) {
    std::vector<Point> outline;
    for (std::size_t i = first; i < last; ++i)
      outline.push_back(frame.At(series.x[i], series.y_low[i]));
    for (std::size_t i = last; i-- > first;)
      outline.push_back(frame.At(series.x[i], series.y_high[i]));
    canvas.Polygon(outline, series.color, kBandOpacity);
  }
}

// "base", or "base: run-1, run-2 and 3 more".
std::string NameWithRuns(const Series& series, const Figure& figure) {
  constexpr std::size_t kMostIds = 3;
  const std::string& of = series.runs_of.empty() ? series.name : series.runs_of;
  for (const auto& [name, ids] : figure.runs) {
    if (name != of || ids.empty()) continue;
    const std::size_t shown = std::min(ids.size(), kMostIds);
    return fmt::format(
        "{}: {}{}", name,
        fmt::join(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
        ids.size() > shown ? fmt::format(" and {} more", ids.size() - shown) : "");
  }
  return series.name;
}

void DrawLine(Canvas& canvas, const Series& series, const PanelFrame& frame, const Figure& figure) {
  const double u = frame.texts.scale;
  for (const auto& [first, last] : Pieces(series)) {
    std::vector<Point> points;
    CurveHint hint{NameWithRuns(series, figure), {}};
    for (std::size_t i = first; i < last; ++i) {
      points.push_back(frame.At(series.x[i], series.y[i]));
      hint.values.emplace_back(series.x[i], series.y[i]);
    }
    if (points.size() == 1) canvas.Disc(points.front(), 1.5 * u, series.color);
    canvas.Polyline(points, {series.color, series.width * u, series.dash * u}, std::move(hint));
  }
}

void DrawPoints(Canvas& canvas, const Series& series, const Panel& panel, const PanelFrame& frame,
                const Figure& figure) {
  const double u = frame.texts.scale;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i])) continue;
    const Point at = frame.At(series.x[i], series.y[i]);
    if (!series.x_reach.empty() && std::isfinite(series.x_reach[i])) {
      const double end = frame.X(series.x_reach[i]);
      canvas.Line(at, {end, at.y}, {series.color, 1.6 * u});
      canvas.Line({end, at.y - 5.0 * u}, {end, at.y + 5.0 * u}, {series.color, 1.6 * u});
    }
    DrawMarkedPoint(canvas, at, series, u);
    canvas.Hint(at, kPointRadius * u,
                fmt::format("{} · {}: {:.4g} · {}: {:.4g}", NameWithRuns(series, figure),
                            panel.x_label, series.x[i], panel.y_label, series.y[i]));
    canvas.Text({at.x + kPointRadius * u, at.y - (kPointRadius + 3.0) * u}, series.label,
                frame.texts.TickText());
  }
}

void DrawBars(Canvas& canvas, const Panel& panel, const PanelFrame& frame) {
  const double half = 0.33 * (frame.bottom - frame.top) / static_cast<double>(panel.y_ticks.size());
  std::vector<double> start(panel.y_ticks.size(), 0.0);
  for (const Series& series : panel.series) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (!std::isfinite(series.x[i])) continue;
      const double left = frame.X(start[i]), right = frame.X(start[i] + series.x[i]);
      canvas.Rectangle({left, frame.Y(series.y[i]) - half}, right - left, 2.0 * half, series.color);
      canvas.Hint({0.5 * (left + right), frame.Y(series.y[i])},
                  std::min(half, 0.5 * (right - left)),
                  fmt::format("{} · {}: {:.4g}", series.name, panel.x_label, series.x[i]));
      start[i] += series.x[i];
    }
  }
}

Color InkOn(const Color& color) {
  const double lightness = 0.3 * color[0] + 0.59 * color[1] + 0.11 * color[2];
  return lightness > 130.0 ? Color{0x22, 0x22, 0x22} : Color{0xff, 0xff, 0xff};
}

void DrawCells(Canvas& canvas, const CellMap& cells, const PanelFrame& frame) {
  Range range;
  for (const std::vector<double>& row : cells.values) range.Add(row);
  const double span = range.largest > range.least ? range.largest - range.least : 1.0;
  TextStyle style = frame.texts.TickText();
  style.anchor = Anchor::kMiddle;
  const auto corner = [&](double x, double y) { return frame.At(x - 0.5, y + 0.5); };
  const double width = frame.X(1.0) - frame.X(0.0), height = frame.Y(0.0) - frame.Y(1.0);
  for (std::size_t y = 0; y < cells.values.size(); ++y) {
    for (std::size_t x = 0; x < cells.values[y].size(); ++x) {
      if (!std::isfinite(cells.values[y][x])) continue;
      const double fx = static_cast<double>(x), fy = static_cast<double>(y);
      const Color fill = ErrorColor((cells.values[y][x] - range.least) / span);
      canvas.Rectangle(corner(fx, fy), width, height, fill);
      style.color = InkOn(fill);
      canvas.Text(frame.At(fx, fy), cells.texts[y][x], style);
    }
  }
  if (!cells.framed) return;
  canvas.Frame(corner(cells.framed->first, cells.framed->second), width, height,
               {kTruthColor, 3.0 * frame.texts.scale});
}

void DrawFailures(Canvas& canvas, const Panel& panel, const PanelFrame& frame) {
  const double u = frame.texts.scale;
  int row = 0;
  for (const Series& series : panel.series) {
    if (series.failed_x.empty()) continue;
    const double y = frame.top + kFailureRow * u * (row++ + 0.5);
    for (const double x : series.failed_x)
      canvas.Cross({frame.X(x), y}, 3.0 * u, {kFailureColor, 1.4 * u});
  }
}

void DrawPanel(Canvas& canvas, const Panel& panel, const PanelFrame& frame, const Figure& figure) {
  if (panel.cells) DrawCells(canvas, *panel.cells, frame);
  DrawAxes(canvas, panel, frame);
  DrawHead(canvas, panel, frame);
  DrawReferences(canvas, panel, frame);
  if (!HasData(panel)) {
    TextStyle style = frame.texts.Label();
    style.color = kReferenceInk;
    style.anchor = Anchor::kMiddle;
    canvas.Text({0.5 * (frame.left + frame.right), 0.5 * (frame.top + frame.bottom)}, "no data",
                style);
  }
  if (HasBars(panel)) return DrawBars(canvas, panel, frame);
  for (const Series& series : panel.series) DrawBand(canvas, series, frame);
  for (const Series& series : panel.series) {
    if (series.mark == Mark::kLine) DrawLine(canvas, series, frame, figure);
    if (series.mark != Mark::kLine) DrawPoints(canvas, series, panel, frame, figure);
  }
  DrawFailures(canvas, panel, frame);
}

}  // namespace

double FigureHeight(const Figure& figure, const FigureStyle& style) {
  return std::ceil(Layout(figure, style).Height());
}

void DrawFigure(Canvas& canvas, const Figure& figure, const FigureStyle& style) {
  const Layout layout(figure, style);
  layout.legend.Draw(canvas);
  for (std::size_t i = 0; i < figure.panels.size(); ++i)
    DrawPanel(canvas, figure.panels[i], PanelFrame(figure.panels[i], layout.TopLeft(i), layout),
              figure);
}

}  // namespace vitruvia
