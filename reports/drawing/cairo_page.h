// Drawings as PDF and PNG, drawn by Cairo with one face: text stays text in a PDF, and the parts of
// the font that it uses are embedded.
#pragma once

#include <string>
#include <vector>

#include "reports/drawing/canvas.h"

namespace vitruvia {

// The file's content: a page of width × height units, each `unit_pt` points (1/72 inch) long.
// RunError if Cairo cannot draw it.
std::string ToPdf(const std::vector<PageShape>& shapes, double width, double height,
                  double unit_pt);
// At `scale` pixels a unit, on white.
std::string ToPng(const std::vector<PageShape>& shapes, double width, double height, double scale);

double MeasuredWidth(const std::string& text, const TextStyle& style);

}  // namespace vitruvia
