// The report as one page that needs nothing but itself.
#pragma once

#include <string>
#include <vector>

#include "analysis/experiment_runs.h"
#include "reports/pictures/pictures.h"

namespace vitruvia {

struct DrawnFigure {
  std::string name, title, caption;
  std::string svg;  // the file's content
};

std::string MakePage(const ReportedExperiment& experiment, const std::vector<DrawnFigure>& figures,
                     const std::vector<RunPictures>& pictures);

}  // namespace vitruvia
