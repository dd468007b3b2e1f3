// Computes the summaries that an experiment defines itself (records/frame_summary.h).
#pragma once

#include <vector>

#include "records/estimate.h"
#include "records/frame_summary.h"
#include "records/run_record.h"
#include "sequence/sequence.h"

namespace vitruvia {

// "" or which joint the skeleton has not.
std::string JointsProblem(const FrameSummary& summary);

// Adds them to the summary row of a scored record. One whose series the run has not, or not in any
// frame, is absent.
void AddSummaries(const SequenceReader& sequence, const EstimateReader& estimate,
                  const std::vector<FrameSummary>& summaries, RunRecord& record);

}  // namespace vitruvia
