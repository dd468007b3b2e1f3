#include "analysis/experiment_runs.h"

#include "core/error.h"
#include "records/metric_value.h"

namespace vitruvia {
namespace fs = std::filesystem;

std::string ContenderOf(const RunRecord& run) { return run.method + "/" + run.variant; }

std::vector<const RunRecord*> ReportedExperiment::finished() const {
  std::vector<const RunRecord*> records;
  for (const ReportedRun& run : runs) {
    if (run.record) records.push_back(&*run.record);
  }
  return records;
}

ReportedExperiment ReadExperiment(const fs::path& folder) {
  ReportedExperiment experiment{folder, ReadExperimentRecord(folder), {}};
  for (const std::string& run_id : experiment.record.run_ids) {
    ReportedRun run{run_id, std::nullopt, ""};
    const auto failed = experiment.record.failed_runs.find(run_id);
    if (failed != experiment.record.failed_runs.end()) {
      run.problem = "failed: " + failed->second;
    } else if (!fs::exists(folder / run_id / "record.json")) {
      run.problem = "missing: it has not been run, or was interrupted";
    } else {
      try {
        RunRecord record = ReadRunRecord(folder, run_id);
        run.problem = UnknownMetricsProblem(record);
        if (run.problem.empty()) run.record = std::move(record);
      } catch (const DataError& error) {
        run.problem = std::string("damaged: ") + error.what();
      }
    }
    experiment.runs.push_back(std::move(run));
  }
  return experiment;
}

}  // namespace vitruvia
