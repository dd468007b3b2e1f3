#include "experiments/cli/problems.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/message.h"

namespace vitruvia {

void PrintProblems(const ReportedExperiment& experiment) {
  for (const ReportedRun& run : experiment.runs) {
    if (!run.problem.empty()) PrintMessage("{}: left out: {}\n", run.run_id, run.problem);
  }
}

void SkippedRuns::SkipIfUnreadable(const std::string& run_id, const std::function<void()>& work) {
  try {
    work();
  } catch (const DataError& error) {
    PrintMessage("{}: skipped: {}\n", run_id, error.what());
    ++count_;
  }
}

void SkippedRuns::RequireNone(const std::filesystem::path& experiment_folder) const {
  if (count_ == 0) return;
  throw DataError(
      fmt::format("{}: {} {} could not be read and {} skipped; vitruvia run --again --only RUN "
                  "carries one out anew",
                  experiment_folder.string(), count_, count_ == 1 ? "run" : "runs",
                  count_ == 1 ? "was" : "were"));
}

}  // namespace vitruvia
