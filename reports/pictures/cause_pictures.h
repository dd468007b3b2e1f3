// The causes of each run's errors, with pictures of the worst events.
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
  std::string problem;  // why there is no diagnosis; "" if there is one
  Diagnosis diagnosis;
  std::vector<Picture> pictures;  // of each event's worst frame: truth and estimate as the camera
                                  // sees them
};

class DrawnBefore;

// One entry per finished tracking run. A sequence's evidence is gathered once for all its runs;
// sequences are processed on all cores. Causes found by an earlier report are reused.
std::vector<RunCauses> FindCauses(const ReportedExperiment& experiment, const DrawnBefore& before);

}  // namespace vitruvia
