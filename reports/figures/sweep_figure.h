// Metrics plotted against the values of a swept setting.
#pragma once

#include <vector>

#include "analysis/experiment_runs.h"
#include "reports/drawing/plot.h"

namespace vitruvia {

// A figure for each swept setting that has several values while the others are at their defaults:
// a panel for each metric (the experiment's table_columns, or its main error and the time of a
// frame), a thin line for each scene, the mean with its bootstrap interval as a band, and the
// setting's default as a dashed line. Of a grid of two settings also a map of each metric over
// both. No figure without a sweep.
std::vector<Figure> MakeSweepFigures(const ReportedExperiment& experiment);

}  // namespace vitruvia
