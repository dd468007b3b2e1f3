// Which frame times a capture system may have.
#pragma once

#include <string>

namespace vitruvia {

// Why a file's time between frames, meant to be seconds, cannot be right, with the likely cause; ""
// if it can.
std::string FrameTimeProblem(double frame_s);

// Why it may be wrong, "" if it is an ordinary one.
std::string FrameTimeDoubt(double frame_s);

}  // namespace vitruvia
