#include "reports/drawing/canvas.h"

#include <sstream>

#include "reports/drawing/cairo_page.h"

namespace vitruvia {

double TextWidth(const std::string& text, const TextStyle& style) {
  return MeasuredWidth(text, style);
}

double BaselineShift(const TextStyle& style) {
  // In shares of the size; the face's capitals are 0.73 high.
  constexpr double kBelowTop = 0.76, kBelowMiddle = 0.36, kBelowBottom = -0.22;
  return style.size * (style.baseline == Baseline::kTop      ? kBelowTop
                       : style.baseline == Baseline::kMiddle ? kBelowMiddle
                                                             : kBelowBottom);
}

namespace {

// Number of bytes of a too wide word that fit on a line: up to a separator in the name, or as many
// letters as fit.
std::size_t BytesThatFit(const std::string& word, double width, const TextStyle& style) {
  std::size_t fits = 1, breaks = 0;
  for (std::size_t i = 1; i < word.size(); ++i) {
    const bool inside_letter = (static_cast<unsigned char>(word[i]) & 0xc0) == 0x80;  // UTF-8
    if (inside_letter) continue;
    if (TextWidth(word.substr(0, i), style) > width) break;
    fits = i;
    if (std::string_view(",_.-/=").find(word[i - 1]) != std::string_view::npos) breaks = i;
  }
  return breaks > 0 ? breaks : fits;
}

}  // namespace

std::vector<std::string> WrappedText(const std::string& text, double width,
                                     const TextStyle& style) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::string longer = lines.empty() ? word : lines.back() + " " + word;
    if (!lines.empty() && TextWidth(longer, style) <= width) {
      lines.back() = longer;
      continue;
    }
    while (word.size() > 1 && TextWidth(word, style) > width) {
      const std::size_t bytes = BytesThatFit(word, width, style);
      lines.push_back(word.substr(0, bytes));
      word.erase(0, bytes);
    }
    lines.push_back(word);
  }
  return lines;
}

void Canvas::Line(Point a, Point b, const Stroke& stroke) { Polyline({a, b}, stroke); }

void Canvas::Polyline(const std::vector<Point>& points, const Stroke& stroke, CurveHint hint) {
  if (points.size() > 1) shapes_.push_back(PolylineShape{points, stroke, std::move(hint)});
}

void Canvas::Rectangle(Point top_left, double width, double height, Color fill, double opacity) {
  const auto [x, y] = top_left;
  Polygon({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, fill, opacity);
}

void Canvas::Frame(Point top_left, double width, double height, const Stroke& stroke) {
  const auto [x, y] = top_left;
  Polyline({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}, {x, y}}, stroke);
}

void Canvas::Polygon(const std::vector<Point>& points, Color fill, double opacity) {
  if (points.size() > 2) shapes_.push_back(PolygonShape{points, fill, opacity});
}

void Canvas::Disc(Point center, double radius, Color fill) {
  shapes_.push_back(DiscShape{center, radius, fill});
}

void Canvas::Cross(Point center, double radius, const Stroke& stroke) {
  const auto [x, y] = center;
  Line({x - radius, y - radius}, {x + radius, y + radius}, stroke);
  Line({x - radius, y + radius}, {x + radius, y - radius}, stroke);
}

void Canvas::Text(Point at, const std::string& text, const TextStyle& style) {
  if (!text.empty()) shapes_.push_back(TextShape{at, text, style});
}

void Canvas::Hint(Point center, double radius, const std::string& text) {
  shapes_.push_back(HintShape{center, radius, text});
}

void Canvas::Image(Point top_left, double width, double height, const Picture& picture) {
  shapes_.push_back(PictureShape{top_left, width, height, &picture});
}

}  // namespace vitruvia
