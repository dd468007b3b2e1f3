// Checks of a frame that all trackers make, and their settings.
#pragma once

#include "config/settings.h"
#include "tracking/tracker.h"

namespace vitruvia {

// std::invalid_argument with the frame's index and both sizes if the size of the image differs from
// that of the camera given to Start.
void CheckFrameSize(const DepthFrame& frame, const PinholeCamera& camera);

// The setting max_depth_m of all trackers.
void DescribeMaxDepth(Fields& fields, double& max_depth_m);
// The setting lost_below of trackers that judge a frame by its agreement (agreement.h).
void DescribeLostBelow(Fields& fields, double& lost_below);

// Message of a frame without a measurement.
inline constexpr const char* kNoMeasurement =
    "the frame holds no measurement; the pose is carried over";

}  // namespace vitruvia
