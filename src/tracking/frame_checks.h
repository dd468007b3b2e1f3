// Checks of a frame that all trackers make.
#pragma once

#include "tracking/tracker.h"

namespace vitruvia {

// std::invalid_argument with the frame's index and both sizes if the size of the image differs from
// that of the camera given to Start.
void CheckFrameSize(const DepthFrame& frame, const PinholeCamera& camera);

}  // namespace vitruvia
