// Shared parts of an experiment's report and the index page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/drawing/drawing_writer.h"
#include "reports/drawing/plot.h"

namespace vitruvia {

struct DrawnFigure {
  std::string name, title, caption;
  std::string svg;  // the file's content
};

// Writes each figure to `folder`, as PNG and SVG under its name.
std::vector<DrawnFigure> DrawFigures(const std::vector<Figure>& figures,
                                     const std::filesystem::path& folder);

// A whole HTML page that needs no other file; `body` is HTML, `title` plain text.
std::string PageOf(const std::string& title, const std::string& body);

// An SVG file's drawing as an element of a page, described by plain text.
std::string InlineSvg(const std::string& svg, const std::string& description);
// A figure with its title, caption and drawing.
std::string FigureHtml(const DrawnFigure& figure);

}  // namespace vitruvia
