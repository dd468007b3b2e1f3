// Drawings as SVG: text stays text.
#pragma once

#include <string>
#include <vector>

#include "reports/drawing/canvas.h"

namespace vitruvia {

// The file's content: a page of width × height units, each `unit_pt` points (1/72 inch) long.
std::string ToSvg(const std::vector<PageShape>& shapes, double width, double height,
                  double unit_pt);

}  // namespace vitruvia
