// The part of a score (score.h) that compares with true surfaces of their own triangles.
#pragma once

#include "records/estimate.h"
#include "records/run_record.h"
#include "sequence/sequence.h"

namespace vitruvia {

// Fills what the record says of the distance between the estimate and the true surface of each
// frame, in both directions, over all and over what the camera would see of each. Nothing where the
// sequence has no such surfaces.
void ScoreOwnSurfaces(const SequenceReader& sequence, const EstimateReader& estimate,
                      RunRecord& record);

}  // namespace vitruvia
