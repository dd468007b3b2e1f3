// The legend of a figure: the names of its series, each with a sample, in lines.
#pragma once

#include <string>
#include <vector>

#include "reports/drawing/canvas.h"

namespace vitruvia {

struct Figure;
struct Series;

inline constexpr double kPointRadius = 5.5;  // in units of the usual style
// The mark of a series of points or rings; `scale`: page units per unit of the usual style.
void DrawMarkedPoint(Canvas& canvas, Point at, const Series& series, double scale);

class Legend {
 public:
  // Of each name once, in a figure that must outlive the legend.
  Legend(const Figure& figure, double width, double scale);

  double height() const { return height_; }
  void Draw(Canvas& canvas) const;

 private:
  struct Entry {
    std::vector<std::string> lines;
    const Series* sample = nullptr;  // null: the cross of failed frames
    double x = 0.0, y = 0.0;         // middle of its first line
  };

  void Place(double width);
  void DrawSample(Canvas& canvas, const Entry& entry) const;

  double scale_, height_ = 0.0;
  std::vector<Entry> entries_;
};

}  // namespace vitruvia
