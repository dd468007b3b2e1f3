// Reports the runs that a command leaves out.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "analysis/experiment_runs.h"

namespace vitruvia {

// Names on standard error every run without a usable record, and why: failed, missing or damaged.
void PrintProblems(const ReportedExperiment& experiment);

// Runs whose stored data cannot be read: each is named on standard error and skipped, so that one
// damaged run does not keep a command from the others.
class SkippedRuns {
 public:
  // Calls `work`; a DataError of it skips the run.
  void SkipIfUnreadable(const std::string& run_id, const std::function<void()>& work);
  int count() const { return count_; }
  // DataError that says how many runs of the folder were skipped, if any were.
  void RequireNone(const std::filesystem::path& experiment_folder) const;

 private:
  int count_ = 0;
};

}  // namespace vitruvia
