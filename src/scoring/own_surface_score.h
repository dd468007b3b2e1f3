// The part of a score (score.h) that compares with true surfaces of their own triangles.
#pragma once

#include "records/estimate.h"
#include "records/run_record.h"
#include "sequence/sequence.h"

namespace vitruvia {

// Fills the record's distances between the estimate and the true surface of each frame, in both
// directions, over all points and over those visible to the camera. Does nothing if the sequence
// has no such surfaces.
void ScoreOwnSurfaces(const SequenceReader& sequence, const EstimateReader& estimate,
                      RunRecord& record);

}  // namespace vitruvia
