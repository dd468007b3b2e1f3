// Reports the runs that a command leaves out.
#pragma once

#include "analysis/experiment_runs.h"

namespace vitruvia {

// Names on standard error every run without a usable record, and why: failed, missing or damaged.
void PrintProblems(const ReportedExperiment& experiment);

}  // namespace vitruvia
