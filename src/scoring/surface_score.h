// The part of a score (score.h) that compares surfaces.
#pragma once

#include "records/estimate.h"
#include "records/run_record.h"
#include "sequence/sequence.h"

namespace vitruvia {

// Fills what the record says of the surface: against the true one where the sequence has one, and
// every so many frames (0: never) against the observed points.
void ScoreSurfaces(const SequenceReader& sequence, const EstimateReader& estimate,
                   int reconstruction_every, RunRecord& record);

}  // namespace vitruvia
