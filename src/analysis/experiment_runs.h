// All runs of an experiment's grid: finished, failed or missing.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "records/run_record.h"

namespace vitruvia {

// The contender that produced the run: "method/variant".
std::string ContenderOf(const RunRecord& run);

struct ReportedRun {
  std::string run_id;
  std::optional<RunRecord> record;
  std::string problem;  // why there is no record; "" if there is one
};

struct ReportedExperiment {
  std::filesystem::path folder;
  ExperimentRecord record;
  std::vector<ReportedRun> runs;  // in the order of the grid

  std::vector<const RunRecord*> finished() const;
};

// A run that failed, is missing, or has a damaged record or an unknown metric is included with its
// problem. DataError if the folder holds no experiment.
ReportedExperiment ReadExperiment(const std::filesystem::path& folder);

}  // namespace vitruvia
