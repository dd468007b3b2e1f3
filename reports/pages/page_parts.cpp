#include "reports/pages/page_parts.h"

#include <fmt/format.h>

#include "core/files.h"
#include "reports/drawing/html_text.h"
#include "reports/pages/page_assets.h"

namespace vitruvia {
namespace fs = std::filesystem;

std::vector<DrawnFigure> DrawFigures(const std::vector<Figure>& figures, const fs::path& folder) {
  std::vector<DrawnFigure> drawn;
  const DrawingWriter writer;
  for (const Figure& figure : figures) {
    const fs::path stem = folder / figure.name;
    writer.Write(stem, FigureStyle{}.width, FigureHeight(figure),
                 [&](Canvas& canvas) { DrawFigure(canvas, figure); });
    drawn.push_back(
        {figure.name, figure.title, figure.caption, ReadWholeFile(fs::path(stem).concat(".svg"))});
  }
  return drawn;
}

std::string PageOf(const std::string& title, const std::string& body) {
  return fmt::format(
             "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
             "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
             "<title>{}</title><link rel=\"icon\" href=\"data:,\"><style>{}</style></head><body>\n",
             Escaped(title), kPageStyle) +
         body + "<script>" + kPageScript + "</script>\n</body></html>\n";
}

std::string InlineSvg(const std::string& svg, const std::string& description) {
  // Inside a page an SVG needs no XML header.
  constexpr std::string_view kStart = "<svg";
  const std::size_t at = svg.find(kStart);
  if (at == std::string::npos) return "";
  // What has points to go to is a group of them to a screen reader, not a single picture.
  const bool has_points = svg.find("tabindex") != std::string::npos;
  return fmt::format("<svg role=\"{}\" aria-label=\"{}\"{}", has_points ? "group" : "img",
                     Escaped(description), svg.substr(at + kStart.size()));
}

std::string FigureHtml(const DrawnFigure& figure) {
  return fmt::format(
      "<figure class=\"plot\"><figcaption><b>{}</b>{}</figcaption><div "
      "class=\"scroll\">{}</div></figure>\n",
      Escaped(figure.title), Escaped(figure.caption), InlineSvg(figure.svg, figure.title));
}

}  // namespace vitruvia
