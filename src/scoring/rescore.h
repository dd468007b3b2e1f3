// Metrics recomputed from what a run left behind, without tracking again.
#pragma once

#include <filesystem>
#include <vector>

#include "records/frame_summary.h"
#include "records/run_record.h"

namespace vitruvia {

// The record that the run would have if it were scored now: its estimate and its sequence read
// again, what names the run and says how it was tracked kept. DataError if either is missing or
// damaged, or if the sequence is not the one that was tracked.
RunRecord Rescored(const std::filesystem::path& experiment_folder, const RunRecord& record,
                   const std::vector<FrameSummary>& summaries);

}  // namespace vitruvia
