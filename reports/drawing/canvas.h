// Flat drawings with VTK's 2-D context, to PNG and SVG alike.
//
// VTK's own charts are not used: the SVG exporter of VTK 9.1 applies a chart's clipping inside the
// data's transform, which cuts the curves away. Drawings here are made of lines, rectangles, discs,
// text and pictures in page coordinates, which come out the same in both formats. The exporter
// leaves pictures out and misplaces text in browsers; both are added to its SVG afterwards.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "reports/drawing/offscreen.h"

class vtkContext2D;

namespace vitruvia {

// Page coordinates: CSS pixels, origin top left, y down.
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

// What is added to an SVG after VTK.
struct PlacedPicture {
  Point top_left;
  double width = 0.0, height = 0.0;
  const ColorImage* picture = nullptr;
};
struct PlacedText {
  Point at;
  std::string text;
  TextStyle style;
};
struct SvgAdditions {
  std::vector<PlacedPicture> pictures;
  std::vector<PlacedText> texts;
};

class Canvas {
 public:
  // `scale` device pixels per page unit. Pictures and text are drawn if `additions` is null, and
  // otherwise put down there.
  Canvas(vtkContext2D& context, double page_height, double scale, SvgAdditions* additions);

  void Line(Point a, Point b, const Stroke& stroke);
  void Polyline(const std::vector<Point>& points, const Stroke& stroke);
  void Rectangle(Point top_left, double width, double height, Color fill, double opacity = 1.0);
  void Disc(Point center, double radius, Color fill);
  void Cross(Point center, double radius, const Stroke& stroke);
  void Text(Point at, const std::string& text, const TextStyle& style);
  // The picture must outlive the drawing.
  void Picture(Point top_left, double width, double height, const ColorImage& picture);

 private:
  void SetPen(const Stroke& stroke);
  void SetFont(const TextStyle& style);
  float X(double x) const { return static_cast<float>(x * scale_); }
  float Y(double y) const { return static_cast<float>((page_height_ - y) * scale_); }

  vtkContext2D* context_;
  double page_height_, scale_;
  SvgAdditions* additions_;
};

// Writes drawings to files. One for many drawings: its OpenGL context and shaders are made once.
class DrawingWriter {
 public:
  DrawingWriter();
  ~DrawingWriter();

  // A drawing of width × height page units, to `stem`.svg, and to `stem`.png at twice that in
  // pixels. RunError if one cannot be written.
  void Write(const std::filesystem::path& stem, int width, int height,
             const std::function<void(Canvas&)>& draw);

 private:
  struct Window;
  std::unique_ptr<Window> window_;
};

}  // namespace vitruvia
