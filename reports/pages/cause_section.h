// The report's section about the causes of errors.
#pragma once

#include <string>
#include <vector>

#include "analysis/experiment_runs.h"
#include "reports/pictures/cause_pictures.h"

namespace vitruvia {

// HTML: how much of each run's error each cause holds, and each run's worst events with pictures;
// "" where no run has frames.
std::string CauseSection(const ReportedExperiment& experiment, const std::vector<RunCauses>& runs);

}  // namespace vitruvia
