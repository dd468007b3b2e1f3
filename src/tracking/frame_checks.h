// What every tracker asks of a frame before it uses it.
#pragma once

#include "tracking/tracker.h"

namespace vitruvia {

// std::invalid_argument with the frame's index and both sizes unless the image has as many columns
// and rows as the camera that Start was given.
void CheckFrameSize(const DepthFrame& frame, const PinholeCamera& camera);

}  // namespace vitruvia
