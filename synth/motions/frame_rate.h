// Plausibility checks of a motion file's frame time.
#pragma once

#include <string>

namespace vitruvia {

// Reason why a file's time between frames (seconds) must be wrong, with the likely cause; "" if it
// may be right.
std::string FrameTimeProblem(double frame_s);

// Reason why it may be wrong; "" if it is a usual one.
std::string FrameTimeDoubt(double frame_s);

}  // namespace vitruvia
