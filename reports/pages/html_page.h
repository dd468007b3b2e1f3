// The report as one self-contained page.
#pragma once

#include <string>
#include <vector>

#include "analysis/experiment_runs.h"
#include "reports/pages/page_parts.h"
#include "reports/pictures/cause_pictures.h"
#include "reports/pictures/pictures.h"

namespace vitruvia {

std::string MakePage(const ReportedExperiment& experiment, const std::vector<DrawnFigure>& figures,
                     const std::vector<RunCauses>& causes,
                     const std::vector<RunPictures>& pictures);

}  // namespace vitruvia
