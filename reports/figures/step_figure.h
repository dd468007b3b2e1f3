// The times of each variant's steps, stacked.
#pragma once

#include <optional>

#include "analysis/experiment_runs.h"
#include "reports/drawing/plot.h"

namespace vitruvia {

// A bar for each variant: its steps' median times, means over the runs. Nothing if no run has
// steps.
std::optional<Figure> MakeStepFigure(const ReportedExperiment& experiment);

}  // namespace vitruvia
