// Finds a limb that has moved away from its predicted place (see tracking/limb_search.h).
#pragma once

#include <optional>
#include <vector>

#include "methods/realtime_scape/pose_fitter.h"
#include "tracking/limb_search.h"

namespace vitruvia::realtime_scape {

LimbBody LimbBodyOf(const Model& model);

class LimbFinder {
 public:
  LimbFinder(const Model& model, const PinholeCamera& camera, const Settings& settings);

  // If enough of the frame is not explained by `current` (`unexplained`: indices of the cloud's
  // points), hypotheses for single limbs are refined. Nothing if none of them is clearly better.
  std::optional<FitSummary> Search(const Observation& observation, const FitSummary& current,
                                   const std::vector<int>& unexplained);

 private:
  Settings settings_;
  LimbSearch search_;
  PoseFitter fitter_;
};

}  // namespace vitruvia::realtime_scape
