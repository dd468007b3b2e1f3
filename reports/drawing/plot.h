// Plots of lines, points, bars and cells on titled panels, drawn on a canvas.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "reports/drawing/axis.h"
#include "reports/drawing/canvas.h"

namespace vitruvia {

enum class Mark {
  kLine,
  kLineWithPoints,  // a disc at each value
  kPoints,
  kRings,
  kStackedBars,  // from left to right at each y, after those of the series before
};

struct Series {
  std::string name;       // in the legend; "": no entry
  std::string runs_of{};  // the name in Figure::runs of what it shows; "": its own
  Color color{};
  double dash = 0.0;   // as Stroke::dash
  double width = 1.8;  // of lines, in units of the usual style
  Mark mark = Mark::kLine;
  std::vector<double> x, y;           // NaN: no value here, a gap
  std::string label;                  // printed beside each point
  std::vector<double> x_reach;        // where a bar to the right of each point ends; empty: no bars
  std::vector<double> failed_x;       // crosses along the top
  std::vector<double> y_low, y_high;  // ends of a band round the line; empty: no band
};

// A value to compare with: a dashed line across the panel.
struct Reference {
  std::string label;
  double value = 0.0;
  bool stretches_axis = true;  // false: it is left out where the data's axis does not reach it
};

// A map of numbers over two settings: a cell round each pair of x_ticks and y_ticks, which stand
// at 0, 1, 2 ….
struct CellMap {
  std::vector<std::vector<double>> values;      // [y][x]; NaN: no value here
  std::vector<std::vector<std::string>> texts;  // printed in the cells
  std::optional<std::pair<int, int>> framed;    // x and y of a cell to point out
};

struct Panel {
  std::string title, x_label, y_label;  // labels name quantity and unit
  std::vector<Series> series;
  std::vector<Reference> y_references, x_references;
  Scale y_scale = Scale::kLinear, x_scale = Scale::kLinear;
  // Fixed ends of linear axes; NaN: from the data.
  double x_end = std::numeric_limits<double>::quiet_NaN();
  double y_end = std::numeric_limits<double>::quiet_NaN();
  // Marked values instead of round ones; they stand at 0, 1, 2 … where they are names.
  std::vector<Tick> x_ticks{}, y_ticks{};
  std::optional<CellMap> cells{};
};

struct Figure {
  std::string name;            // of its files, without ending
  std::string title, caption;  // plain text
  int columns = 1;             // of panels, at most; rows follow, and few panels are wider
  std::vector<Panel> panels;
  // Runs behind the legend's names: name → ids of runs. Written beside figures for papers, and
  // shown on hover.
  std::vector<std::pair<std::string, std::vector<std::string>>> runs{};
};

// Page units. The usual one is that of report pages.
struct FigureStyle {
  double width = 780.0;
  double text_size = 13.0;  // of labels
};

double FigureHeight(const Figure& figure, const FigureStyle& style = {});
void DrawFigure(Canvas& canvas, const Figure& figure, const FigureStyle& style = {});

}  // namespace vitruvia
