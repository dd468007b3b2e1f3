// The report's table of variants against each other.
#pragma once

#include <string>

#include "reports/experiment_runs.h"

namespace vitruvia {

// HTML; "" where fewer than two variants have finished runs.
std::string ComparisonSection(const ReportedExperiment& experiment);

}  // namespace vitruvia
