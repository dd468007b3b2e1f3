#include "tracking/frame_checks.h"

#include "core/error.h"

namespace vitruvia {

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

}  // namespace vitruvia
