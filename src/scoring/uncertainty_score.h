// The part of a score (score.h) that evaluates a tracker's uncertainty estimates.
#pragma once

#include "records/estimate.h"
#include "records/run_record.h"
#include "sequence/sequence.h"

namespace vitruvia {

// A joint with an error up to this counts as reliable.
inline constexpr double kReliableWithin_m = 0.05;

// Fills coverage, negative log-likelihood and the quality of the flags of unreliable joints, over
// the visible joints with a covariance. Does nothing if the tracker gives no covariances.
void ScoreUncertainty(const SequenceReader& sequence, const EstimateReader& estimate,
                      RunRecord& record);

}  // namespace vitruvia
