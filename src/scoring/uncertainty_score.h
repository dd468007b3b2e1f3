// The part of a score (score.h) that asks whether a tracker knows its error.
#pragma once

#include "records/estimate.h"
#include "records/run_record.h"
#include "sequence/sequence.h"

namespace vitruvia {

// Errors up to this are those of a joint that may be relied on.
inline constexpr double kReliableWithin_m = 0.05;

// Fills coverage, negative log-likelihood and what the flags of unreliable joints are worth, over
// the visible joints whose covariance the tracker gives. Nothing where it gives none.
void ScoreUncertainty(const SequenceReader& sequence, const EstimateReader& estimate,
                      RunRecord& record);

}  // namespace vitruvia
