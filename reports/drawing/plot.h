// Plots of lines and points on titled panels, drawn on a canvas.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "reports/drawing/axis.h"
#include "reports/drawing/canvas.h"

namespace vitruvia {

enum class Mark { kLine, kPoints, kRings };

struct Series {
  std::string name;
  Color color{};
  double dash = 0.0;  // as Stroke::dash
  Mark mark = Mark::kLine;
  std::vector<double> x, y;      // NaN: no value here, a gap
  std::string label;             // beside each point
  std::vector<double> x_reach;   // where a bar to the right of each point ends; empty: no bars
  std::vector<double> failed_x;  // crosses along the top
};

// A published value: a dashed line across the panel.
struct Reference {
  std::string label;
  double value = 0.0;
};

struct Panel {
  std::string title, x_label, y_label;  // labels name quantity and unit
  std::vector<Series> series;
  std::vector<Reference> y_references, x_references;
  Scale y_scale = Scale::kLinear, x_scale = Scale::kLinear;
  // Fixed ends of linear axes; NaN: from the data.
  double x_end = std::numeric_limits<double>::quiet_NaN();
  double y_end = std::numeric_limits<double>::quiet_NaN();
};

struct Figure {
  std::string name;            // of its files, without ending
  std::string title, caption;  // plain text
  int columns = 1;             // of panels; rows follow
  std::vector<Panel> panels;
};

// Page units. All figures are equally wide.
inline constexpr int kFigureWidth = 780;
int FigureHeight(const Figure& figure);

void DrawFigure(Canvas& canvas, const Figure& figure);

}  // namespace vitruvia
