// Recomputes metrics from a run's stored estimate, without tracking again.
#pragma once

#include <filesystem>
#include <vector>

#include "records/frame_summary.h"
#include "records/run_record.h"

namespace vitruvia {

// The record with all scores recomputed from the stored estimate and the sequence; the run's
// identity, settings and provenance are kept. DataError if either is missing or damaged, or if the
// sequence is not the one that was tracked.
RunRecord Rescored(const std::filesystem::path& experiment_folder, const RunRecord& record,
                   const std::vector<FrameSummary>& summaries);

}  // namespace vitruvia
