// The report's section about the causes of errors.
#pragma once

#include <string>
#include <vector>

#include "analysis/experiment_runs.h"
#include "reports/pictures/cause_pictures.h"

namespace vitruvia {

// HTML: the share of each cause in each run's error, and each run's worst events with pictures; ""
// if no run has frames.
std::string CauseSection(const ReportedExperiment& experiment, const std::vector<RunCauses>& runs);

}  // namespace vitruvia
