// Detects estimates far away from all measurements.
#pragma once

#include "tracking/tracker.h"

namespace vitruvia {

// An estimate is astray if a vertex is farther than this from the centre of the measured points, in
// diagonals of the subject in the rest pose: no pose and no noise explains such a distance.
inline constexpr double kAstrayBeyond_diagonals = 10.0;

// Marks an astray result that is not yet a failure as lost, for any method; the message states the
// distance. Frames without measurements are not checked.
void MarkAstray(const DepthFrame& frame, const PinholeCamera& camera, double diagonal_m,
                TrackResult& result);

}  // namespace vitruvia
