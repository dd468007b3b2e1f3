// A tracking run's stored data, open for export.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "records/estimate.h"
#include "records/run_record.h"
#include "sequence/sequence.h"

namespace vitruvia {

struct ExportedRun {
  RunRecord record;
  EstimateReader estimate;
  SequenceReader sequence;
  std::vector<int> frames;  // to be exported, in the order asked for
};

// `frames`: all if there are none. DataError if the run has no estimate, its sequence is gone, or
// there is no such frame.
ExportedRun OpenForExport(const std::filesystem::path& experiment_folder, const std::string& run_id,
                          std::vector<int> frames);

}  // namespace vitruvia
