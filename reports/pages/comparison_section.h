// The report's tables that compare variants.
#pragma once

#include <string>

#include "analysis/experiment_runs.h"

namespace vitruvia {

// HTML; both "" where fewer than two variants have finished runs.
// One row for each variant: means, and differences to the first.
std::string VariantSection(const ReportedExperiment& experiment);
// One row for each metric and variant, with pairs and verdicts.
std::string ComparisonSection(const ReportedExperiment& experiment);

}  // namespace vitruvia
