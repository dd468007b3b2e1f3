// The part of a score (score.h) that compares surfaces.
#pragma once

#include "records/estimate.h"
#include "records/run_record.h"
#include "sequence/sequence.h"

namespace vitruvia {

// Fills the record's surface metrics: against the true surface if the sequence has one, and in
// every `reconstruction_every`-th frame (0: never) against the observed points.
void ScoreSurfaces(const SequenceReader& sequence, const EstimateReader& estimate,
                   int reconstruction_every, RunRecord& record);

}  // namespace vitruvia
