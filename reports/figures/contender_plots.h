// Plots of contenders (a method with a variant) over all scenes of an experiment.
#pragma once

#include <vector>

#include "analysis/experiment_runs.h"
#include "reports/drawing/plot.h"

namespace vitruvia {

inline constexpr const char* kContenderAccuracy = "accuracy-of-contenders";
inline constexpr const char* kJointsByScene = "joints-by-scene";

// Of the finished runs with joints:
// kContenderAccuracy: the share of joints within a threshold, a curve for each contender, averaged
//   over its runs, with and without each joint's mean offset.
// kJointsByScene: the share within 10 cm as a histogram over the scenes.
// None without such runs.
std::vector<Figure> MakeContenderPlots(const ReportedExperiment& experiment);

}  // namespace vitruvia
