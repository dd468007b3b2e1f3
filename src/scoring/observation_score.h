// The part of a score (score.h) that needs no truth.
#pragma once

#include "records/estimate.h"
#include "records/run_record.h"
#include "sequence/sequence.h"

namespace vitruvia {

// Fills the record's metrics that compare the estimate with the depth of the camera and of other
// cameras, and those of limb lengths. To be called after the scores against the truth, if there are
// any.
void ScoreObservation(const SequenceReader& sequence, const EstimateReader& estimate,
                      RunRecord& record);

}  // namespace vitruvia
