// The part of a score (score.h) that compares with the Cramér–Rao bound of single frames.
#pragma once

#include "bound/pose_prior.h"
#include "config/settings.h"
#include "records/estimate.h"
#include "records/run_record.h"
#include "sequence/sequence.h"

namespace vitruvia {

struct BoundSettings {
  int every = 0;  // frames; 0: the bound is not computed
  PosePrior prior;

  void Describe(Fields& fields);
};

// Fills bound and error, as root mean squares over the frames in which a joint is visible, and
// their quotient, for each joint and over all joints. Does nothing if `every` is 0; DataError if
// the sequence has no bound.
void ScoreBound(const SequenceReader& sequence, const EstimateReader& estimate,
                const BoundSettings& settings, RunRecord& record);

}  // namespace vitruvia
