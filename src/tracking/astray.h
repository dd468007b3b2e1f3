// Whether an estimate has left everything that the camera saw.
#pragma once

#include "tracking/tracker.h"

namespace vitruvia {

// A vertex farther than this from the middle of the measured points, in diagonals of the subject at
// rest, is an estimate gone astray: no pose and no noise puts one there.
inline constexpr double kAstrayBeyond_diagonals = 10.0;

// A result that has gone astray and is not yet a failure becomes a lost frame, whichever method it
// is of; the message says how far. Frames without measurements say nothing.
void MarkAstray(const DepthFrame& frame, const PinholeCamera& camera, double diagonal_m,
                TrackResult& result);

}  // namespace vitruvia
