#include "reports/drawing/legend.h"

#include <algorithm>

#include "reports/drawing/color_maps.h"
#include "reports/drawing/plot.h"

namespace vitruvia {
namespace {

constexpr double kText = 13.0, kLeft = 14.0, kLine = 20.0, kSample = 26.0, kSpace = 18.0;
constexpr double kRingWidth = 2.2;
constexpr Color kRingHole{0xff, 0xff, 0xff};

}  // namespace

void DrawMarkedPoint(Canvas& canvas, Point at, const Series& series, double scale) {
  canvas.Disc(at, kPointRadius * scale, series.color);
  if (series.mark == Mark::kRings) canvas.Disc(at, (kPointRadius - kRingWidth) * scale, kRingHole);
}

Legend::Legend(const Figure& figure, double width, double scale) : scale_(scale) {
  const TextStyle style{.size = scale * kText};
  const auto add = [&](const std::string& name, const Series* sample) {
    entries_.push_back({WrappedText(name, width - (kLeft + kSample) * scale, style), sample});
  };
  std::vector<std::string> names;
  bool failures = false;
  for (const Panel& panel : figure.panels) {
    for (const Series& series : panel.series) {
      failures = failures || !series.failed_x.empty();
      const bool known = std::find(names.begin(), names.end(), series.name) != names.end();
      if (known || series.name.empty()) continue;
      names.push_back(series.name);
      add(series.name, &series);
    }
  }
  if (failures) add("failed frame", nullptr);
  Place(width);
}

void Legend::Place(double width) {
  const TextStyle style{.size = scale_ * kText};
  const double line = kLine * scale_;
  double x = kLeft * scale_, y = 0.0, next_y = 0.0;
  for (Entry& entry : entries_) {
    double text_width = 0.0;
    for (const std::string& text : entry.lines)
      text_width = std::max(text_width, TextWidth(text, style));
    const double end = x + kSample * scale_ + text_width;
    if (end > width && x > kLeft * scale_) {
      x = kLeft * scale_;
      y = next_y;
    }
    entry.x = x;
    entry.y = y + 0.5 * line + 4.0 * scale_;
    next_y = std::max(next_y, y + line * static_cast<double>(entry.lines.size()));
    x += (kSample + kSpace) * scale_ + text_width;
  }
  if (!entries_.empty()) height_ = next_y + 6.0 * scale_;
}

void Legend::DrawSample(Canvas& canvas, const Entry& entry) const {
  const double u = scale_;
  const Point middle{entry.x + 0.5 * (kSample - 6.0) * u, entry.y};
  if (entry.sample == nullptr) return canvas.Cross(middle, 3.5 * u, {kFailureColor, 1.6 * u});
  const Series& series = *entry.sample;
  switch (series.mark) {
    case Mark::kLine:
    case Mark::kLineWithPoints:
      return canvas.Line({entry.x, entry.y}, {entry.x + (kSample - 6.0) * u, entry.y},
                         {series.color, std::max(series.width, 1.8) * u, series.dash * u});
    case Mark::kStackedBars:
      return canvas.Rectangle({middle.x - 6.0 * u, middle.y - 6.0 * u}, 12.0 * u, 12.0 * u,
                              series.color);
    case Mark::kPoints:
    case Mark::kRings:
      return DrawMarkedPoint(canvas, middle, series, u);
  }
}

void Legend::Draw(Canvas& canvas) const {
  const TextStyle style{.size = scale_ * kText};
  for (const Entry& entry : entries_) {
    DrawSample(canvas, entry);
    double y = entry.y;
    for (const std::string& text : entry.lines) {
      canvas.Text({entry.x + kSample * scale_, y}, text, style);
      y += kLine * scale_;
    }
  }
}

}  // namespace vitruvia
