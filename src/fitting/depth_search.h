// Finds a body's pose in a depth frame without a start that is known.
//
// Hypotheses are compared by rendering alone, the best ones varied (fitting/pose_variation.h),
// fitted, varied and fitted again, with fewer at each step. An arm that the frame does not show is
// put where it is most likely: as the other arm is held, if the frame allows it.
#pragma once

#include "fitting/depth_target.h"
#include "fitting/pose_search.h"

namespace vitruvia {

// The person as the search sees it, coarse and fine, and whether its shape is fitted too.
struct DepthSearch {
  PoseFit* coarse = nullptr;
  PoseFit* fine = nullptr;
  DepthTarget* coarse_target = nullptr;
  DepthTarget* fine_target = nullptr;
  bool moves_shape = false;
};

// The hypotheses must outlive the outcome. World frame of the targets: y is vertical.
SearchOutcome SearchDepth(const std::vector<PoseHypothesis>& hypotheses, const DepthSearch& search,
                          FitPriors priors, const NearFar& limits);

}  // namespace vitruvia
