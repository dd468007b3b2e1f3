// The part of a score (score.h) that needs no truth.
#pragma once

#include "records/estimate.h"
#include "records/run_record.h"
#include "sequence/sequence.h"

namespace vitruvia {

// Fills what the record says of the estimate against what the camera saw, and what other cameras
// saw; and of limb lengths. After the scores against the truth, where there are any.
void ScoreObservation(const SequenceReader& sequence, const EstimateReader& estimate,
                      RunRecord& record);

}  // namespace vitruvia
