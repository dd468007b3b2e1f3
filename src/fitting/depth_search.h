// Finds a body's pose in a depth frame without a known start.
//
// All hypotheses are compared by rendering alone; then the best ones are varied
// (fitting/pose_variation.h), fitted, varied and fitted again, with fewer hypotheses at each step.
// An arm that is not visible in the frame is given the pose of the other arm if the frame does not
// contradict it.
#pragma once

#include "fitting/depth_target.h"
#include "fitting/pose_search.h"

namespace vitruvia {

// The body and the target at coarse and fine resolution, and whether the shape is fitted too.
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
