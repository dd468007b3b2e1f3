// Speed against error of all variants, with the Pareto front.
#pragma once

#include "analysis/experiment_runs.h"
#include "metrics/catalogue.h"
#include "reports/drawing/plot.h"

namespace vitruvia {

// One point for each variant that has runs with frames: the median time of a frame with a bar to
// the 95th percentile, and the mean error. A panel for each of two to four scenes, else one over
// all scenes. Variants on the Pareto front are discs on a dashed line, the others are rings.
Figure MakeSpeedFigure(const ReportedExperiment& experiment);

// The error metric of the plot: the first metric of Place::kSpeedPlot that some run has, or the
// first of all if no run has any.
Metric ErrorMetricOf(const ReportedExperiment& experiment);

// The values that papers publish of a metric, in its unit, as lines across a plot.
std::vector<Reference> PublishedReferences(const ExperimentRecord& experiment,
                                           const Metric& metric);

}  // namespace vitruvia
