// Checks of a frame that all trackers make, and their settings.
#pragma once

#include <optional>
#include <string>

#include "config/settings.h"
#include "geometry/point_cloud.h"
#include "tracking/tracker.h"

namespace vitruvia {

// std::invalid_argument with the frame's index and both sizes if the size of the image differs from
// that of the camera given to Start.
void CheckFrameSize(const DepthFrame& frame, const PinholeCamera& camera);

// The setting max_depth_m of all trackers.
void DescribeMaxDepth(Fields& fields, double& max_depth_m);
// The setting lost_below of trackers that judge a frame by its agreement (agreement.h).
void DescribeLostBelow(Fields& fields, double& lost_below);

// The setting least_points of trackers that do not fit a frame with too few points.
inline constexpr int kLeastPoints = 17;
void DescribeLeastPoints(Fields& fields, int& least_points);

// Outcome and message of a frame that is not fitted.
struct UnfittedFrame {
  Outcome outcome;
  std::string message;
};
// Nothing if at least `least_points` pixels of the image are measured, and the cloud that was taken
// from it, which may skip pixels, holds one. kNoData if the image holds no measurement.
std::optional<UnfittedFrame> CheckPoints(const PointCloud& cloud, const DepthImage& depth,
                                         double max_depth_m, int least_points);

// Message of a frame without a measurement.
inline constexpr const char* kNoMeasurement =
    "the frame holds no measurement; the pose is carried over";

}  // namespace vitruvia
