// Frames of a motion side by side, as stick figures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "math/vector.h"
#include "reports/drawing/drawing_writer.h"

namespace vitruvia {

// A bone to draw: subject's axes (x left, y up, z front), metres.
struct Stick {
  Vector3<double> from, to;
  Stroke stroke;
};

struct StickFigure {
  std::string label;                                 // above it
  Vector3<double> center = Vector3<double>::Zero();  // its x and z are in the middle of the panel
  std::vector<Stick> sticks;
};

// Figures of one kind, in the order of time; drawn from the front and from the side.
struct StickFigureRow {
  std::string title;
  std::vector<StickFigure> figures;
};

// Writes `stem`.png and `stem`.svg: for each row a line of front views, seen from the front of the
// first frame, and a line of side views, with that front on the right. The grey line marks the
// lowest point of the row. RunError if a file cannot be written.
void WriteMotionStrip(const std::filesystem::path& stem, const std::string& title,
                      const std::vector<StickFigureRow>& rows);

}  // namespace vitruvia
