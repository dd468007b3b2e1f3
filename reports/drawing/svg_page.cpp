#include "reports/drawing/svg_page.h"

#include <fmt/format.h>

#include "reports/drawing/html_text.h"

namespace vitruvia {
namespace {

std::string Coordinates(const std::vector<Point>& points) {
  std::string text;
  for (const Point& p : points)
    text += fmt::format("{}{:.7g},{:.7g}", text.empty() ? "" : " ", p.x, p.y);
  return text;
}

// Names and values of a curve, for the page's script.
std::string Attributes(const CurveHint& hint) {
  if (hint.name.empty()) return "";
  std::string values;
  for (const auto& [x, y] : hint.values)
    values += fmt::format("{}{:.5g} {:.4g}", values.empty() ? "" : ",", x, y);
  return fmt::format(" data-name=\"{}\" data-values=\"{}\"", Escaped(hint.name), values);
}

std::string Element(const PolylineShape& line) {
  const std::string dash =
      line.stroke.dash > 0.0 ? fmt::format(" stroke-dasharray=\"{:g}\"", line.stroke.dash) : "";
  return fmt::format(
      "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\"{}{}/>\n",
      Coordinates(line.points), CssColor(line.stroke.color), line.stroke.width, dash,
      Attributes(line.hint));
}

std::string Element(const PolygonShape& polygon) {
  const std::string opacity =
      polygon.opacity < 1.0 ? fmt::format(" fill-opacity=\"{:g}\"", polygon.opacity) : "";
  return fmt::format("<polygon points=\"{}\" fill=\"{}\"{}/>\n", Coordinates(polygon.points),
                     CssColor(polygon.fill), opacity);
}

std::string Element(const DiscShape& disc) {
  return fmt::format("<circle cx=\"{:.7g}\" cy=\"{:.7g}\" r=\"{:g}\" fill=\"{}\"/>\n",
                     disc.center.x, disc.center.y, disc.radius, CssColor(disc.fill));
}

std::string Element(const TextShape& t) {
  const char* anchor = t.style.anchor == Anchor::kStart    ? "start"
                       : t.style.anchor == Anchor::kMiddle ? "middle"
                                                           : "end";
  // Renderers disagree on dominant-baseline, so the shift is made here.
  return fmt::format(
      "<text transform=\"translate({:.7g} {:.7g}) rotate({})\" y=\"{:.2f}\" font-size=\"{:g}\" "
      "font-weight=\"{}\" text-anchor=\"{}\" fill=\"{}\">{}</text>\n",
      t.at.x, t.at.y, t.style.direction == Direction::kUpwards ? -90 : 0, BaselineShift(t.style),
      t.style.size, t.style.bold ? 700 : 400, anchor, CssColor(t.style.color), Escaped(t.text));
}

std::string Element(const HintShape& h) {
  return fmt::format(
      "<circle cx=\"{:.7g}\" cy=\"{:.7g}\" r=\"{:g}\" fill=\"#fff\" fill-opacity=\"0\" "
      "tabindex=\"0\" role=\"img\" aria-label=\"{}\"/>\n",
      h.center.x, h.center.y, h.radius, Escaped(h.text));
}

std::string Element(const PictureShape& p) {
  return fmt::format(
      "<image x=\"{:.7g}\" y=\"{:.7g}\" width=\"{:.7g}\" height=\"{:.7g}\" xlink:href=\"{}\"/>\n",
      p.top_left.x, p.top_left.y, p.width, p.height, DataUri(p.picture->png));
}

}  // namespace

std::string ToSvg(const std::vector<PageShape>& shapes, double width, double height,
                  double unit_pt) {
  std::string svg = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg viewBox=\"0 0 {0:.7g} {1:.7g}\" width=\"{2:.7g}pt\" height=\"{3:.7g}pt\" "
      "xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
      "font-family=\"'{4}', Arial, Helvetica, sans-serif\">\n"
      "<rect width=\"{0:.7g}\" height=\"{1:.7g}\" fill=\"#ffffff\"/>\n",
      width, height, width * unit_pt, height * unit_pt, kFontFamily);
  for (const PageShape& shape : shapes) {
    svg += std::visit([](const auto& s) { return Element(s); }, shape);
  }
  return svg + "</svg>\n";
}

}  // namespace vitruvia
