#include "tracking/frame_checks.h"

#include "core/error.h"

namespace vitruvia {

void CheckFrameSize(const DepthFrame& frame, const PinholeCamera& camera) {
  Require(frame.depth.width() == camera.width && frame.depth.height() == camera.height,
          "frame {} is {}×{} pixels, the camera {}×{}", frame.index, frame.depth.width(),
          frame.depth.height(), camera.width, camera.height);
}

}  // namespace vitruvia
