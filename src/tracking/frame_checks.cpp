#include "tracking/frame_checks.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"

namespace vitruvia {
namespace {

bool HoldsMeasurement(const DepthImage& depth, double max_depth_m) {
  return std::any_of(depth.pixels().begin(), depth.pixels().end(), [&](float depth_m) {
    return depth_m > 0.0f && depth_m <= static_cast<float>(max_depth_m);
  });
}

}  // namespace

void CheckFrameSize(const DepthFrame& frame, const PinholeCamera& camera) {
  Require(frame.depth.width() == camera.width && frame.depth.height() == camera.height,
          "frame {} is {}×{} pixels, the camera {}×{}", frame.index, frame.depth.width(),
          frame.depth.height(), camera.width, camera.height);
}

void DescribeMaxDepth(Fields& f, double& max_depth_m) {
  f.Number("max_depth_m", max_depth_m,
           {.meaning = "pixels with a larger depth are not measurements of the subject",
            .unit = "m",
            .min = 0.1,
            .max = 100,
            .origin = Origin::kGuessed,
            .source = "range of the depth cameras in use"});
}

void DescribeLostBelow(Fields& f, double& lost_below) {
  f.Number("lost_below", lost_below,
           {.meaning = "a frame is lost when it confirms a smaller share of the model's visible "
                       "vertices, of those that the frame can confirm or contradict",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = "the papers are silent"});
}

void DescribeLeastPoints(Fields& f, int& least_points) {
  f.Integer("least_points", least_points,
            {.meaning = "a frame is lost, and the pose is kept, when fewer of the pixels that the "
                        "tracker reads are measured: a few points fit any pose",
             .min = 1,
             .max = 100000,
             .origin = Origin::kGuessed,
             .source = "the papers are silent; one point for each of the 17 bones"});
}

std::optional<UnfittedFrame> CheckPoints(const PointCloud& cloud, const DepthImage& depth,
                                         double max_depth_m, int least_points) {
  const std::size_t count = cloud.points.size();
  if (count >= static_cast<std::size_t>(least_points)) return {};
  if (count == 0 && !HoldsMeasurement(depth, max_depth_m))
    return UnfittedFrame{Outcome::kNoData, kNoMeasurement};
  return UnfittedFrame{
      Outcome::kLost,
      fmt::format("the frame gives {} {}, too few to fix a pose: expected at least {}; the pose is "
                  "carried over",
                  count, count == 1 ? "point" : "points", least_points)};
}

}  // namespace vitruvia
