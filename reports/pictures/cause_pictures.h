// What went wrong in each run and why, with pictures of the worst events.
#pragma once

#include <string>
#include <vector>

#include "analysis/experiment_runs.h"
#include "diagnosis/diagnosis.h"
#include "reports/drawing/color_image.h"

namespace vitruvia {

inline constexpr int kEventPictureSize = 120;  // pixels, width and height

struct RunCauses {
  std::string run_id;
  std::string problem;  // why nothing is known; "" when all is well
  Diagnosis diagnosis;
  std::vector<Picture> pictures;  // of each event's worst frame: truth and estimate as the camera
                                  // sees them
};

class DrawnBefore;

// One entry per finished tracking run. What a sequence says is gathered once for all its runs;
// sequences go on all cores. What was found before is taken as it is.
std::vector<RunCauses> FindCauses(const ReportedExperiment& experiment, const DrawnBefore& before);

}  // namespace vitruvia
