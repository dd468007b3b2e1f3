// Two-dimensional drawings independent of the file format: lines, areas, text and pictures on a
// page.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "reports/drawing/color_image.h"

namespace vitruvia {

// Page units, origin top left, y down. The writer of a drawing defines the length of a unit.
struct Point {
  double x = 0.0, y = 0.0;
};

struct Stroke {
  Color color{0, 0, 0};
  double width = 1.0;
  double dash = 0.0;  // length of dashes and of the gaps between them; 0: solid
};

enum class Anchor { kStart, kMiddle, kEnd };     // of a text's line at its point
enum class Baseline { kTop, kMiddle, kBottom };  // of a text's height at its point
enum class Direction { kRightwards, kUpwards };

struct TextStyle {
  double size = 13.0;
  Color color{0x22, 0x22, 0x22};
  Anchor anchor = Anchor::kStart;
  Baseline baseline = Baseline::kMiddle;
  Direction direction = Direction::kRightwards;
  bool bold = false;
};

// The face of all text. Arial and Helvetica have the same widths, for readers that lack it.
inline constexpr const char* kFontFamily = "Liberation Sans";
// Width of a text in that font, page units.
double TextWidth(const std::string& text, const TextStyle& style);
// From a text's point down to its baseline.
double BaselineShift(const TextStyle& style);
// The text in lines that are not wider than `width` where it has spaces to break at.
std::vector<std::string> WrappedText(const std::string& text, double width, const TextStyle& style);

// Text that a page shows when the pointer is near a point of a curve.
struct CurveHint {
  std::string name;                               // "": nothing
  std::vector<std::pair<double, double>> values;  // of each point
};

struct PolylineShape {
  std::vector<Point> points;
  Stroke stroke;
  CurveHint hint{};
};
struct PolygonShape {
  std::vector<Point> points;
  Color fill{};
  double opacity = 1.0;
};
struct DiscShape {
  Point center;
  double radius = 0.0;
  Color fill{};
};
struct TextShape {
  Point at;
  std::string text;
  TextStyle style;
};
struct PictureShape {
  Point top_left;
  double width = 0.0, height = 0.0;
  const Picture* picture = nullptr;
};
// An invisible area that shows its text on hover or keyboard focus; only in SVG.
struct HintShape {
  Point center;
  double radius = 0.0;
  std::string text;
};
using PageShape =
    std::variant<PolylineShape, PolygonShape, DiscShape, TextShape, PictureShape, HintShape>;

// Collects what is drawn, in order: later shapes cover earlier ones.
class Canvas {
 public:
  void Line(Point a, Point b, const Stroke& stroke);
  void Polyline(const std::vector<Point>& points, const Stroke& stroke, CurveHint hint = {});
  void Rectangle(Point top_left, double width, double height, Color fill, double opacity = 1.0);
  void Frame(Point top_left, double width, double height, const Stroke& stroke);
  void Polygon(const std::vector<Point>& points, Color fill, double opacity = 1.0);
  void Disc(Point center, double radius, Color fill);
  void Cross(Point center, double radius, const Stroke& stroke);
  void Text(Point at, const std::string& text, const TextStyle& style);
  void Hint(Point center, double radius, const std::string& text);
  // The picture must outlive the canvas.
  void Image(Point top_left, double width, double height, const Picture& picture);

  const std::vector<PageShape>& shapes() const { return shapes_; }

 private:
  std::vector<PageShape> shapes_;
};

}  // namespace vitruvia
