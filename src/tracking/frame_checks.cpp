#include "tracking/frame_checks.h"

#include <fmt/format.h>

#include "core/error.h"

namespace vitruvia {
namespace {

// Number of the image's measurements, counted up to `enough`.
int CountMeasurements(const DepthImage& depth, double max_depth_m, int enough) {
  int count = 0;
  for (const float depth_m : depth.pixels()) {
    count += depth_m > 0.0f && depth_m <= static_cast<float>(max_depth_m) ? 1 : 0;
    if (count == enough) break;
  }
  return count;
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
  f.Integer(
      "least_points", least_points,
      {.meaning = "a frame is lost, and the pose is kept, when fewer of its pixels are measured: "
                  "a few points fit any pose",
       .min = 1,
       .max = 100000,
       .origin = Origin::kGuessed,
       .source = "the papers are silent; one point for each of the 17 bones"});
}

std::optional<UnfittedFrame> CheckPoints(const PointCloud& cloud, const DepthImage& depth,
                                         double max_depth_m, int least_points) {
  const int count = CountMeasurements(depth, max_depth_m, least_points);
  if (count == 0) return UnfittedFrame{Outcome::kNoData, kNoMeasurement};
  if (count == least_points && !cloud.points.empty()) return {};
  return UnfittedFrame{
      Outcome::kLost,
      count < least_points
          ? fmt::format(
                "the frame has {} measured {}, too few to fix a pose: expected at least {}; "
                "the pose is carried over",
                count, count == 1 ? "pixel" : "pixels", least_points)
          : std::string("the tracker reads none of the frame's measured pixels: the stride of the "
                        "cloud leaves them out; the pose is carried over")};
}

}  // namespace vitruvia
