// The report's plots, made of run records.
#pragma once

#include <vector>

#include "analysis/experiment_runs.h"
#include "reports/drawing/plot.h"

namespace vitruvia {

// The figure that every experiment with a finished run has.
inline constexpr const char* kSpeedFigure = "speed-against-error";

// Error per frame, joint accuracy and time per frame for each scene, and speed against error of all
// variants (speed_figure.h). DataError naming run and key if a record lacks a series.
std::vector<Figure> MakeFigures(const ReportedExperiment& experiment);

}  // namespace vitruvia
