// Computes the summaries that an experiment defines itself (records/frame_summary.h).
#pragma once

#include <vector>

#include "records/estimate.h"
#include "records/frame_summary.h"
#include "records/run_record.h"
#include "sequence/sequence.h"

namespace vitruvia {

// "" or a message that names a joint missing from the skeleton.
std::string JointsProblem(const FrameSummary& summary);

// Adds them to the summary row of a scored record. A summary is absent if the run does not have its
// series or has no value in any frame.
void AddSummaries(const SequenceReader& sequence, const EstimateReader& estimate,
                  const std::vector<FrameSummary>& summaries, RunRecord& record);

}  // namespace vitruvia
