// An experiment as its report sees it: every run of the grid, there or not.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "records/run_record.h"

namespace vitruvia {

struct ReportedRun {
  std::string run_id;
  std::optional<RunRecord> record;
  std::string problem;  // why there is no record; "" where there is one
};

struct ReportedExperiment {
  std::filesystem::path folder;
  ExperimentRecord record;
  std::vector<ReportedRun> runs;  // in the order of the grid

  std::vector<const RunRecord*> finished() const;
};

// A run that failed, is missing or has a damaged record is there with its problem. DataError if the
// folder holds no experiment.
ReportedExperiment ReadExperiment(const std::filesystem::path& folder);

}  // namespace vitruvia
