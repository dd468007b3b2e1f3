// The files of an experiment that speak of all its runs: plan.json, experiment.json, summary.json.
#include "analysis/variant_comparison.h"
#include "core/build_info.h"
#include "core/files.h"
#include "experiments/run/run_state.h"
#include "experiments/run/runner.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kStaleReason =
    "stale: made from other settings or by another build, and not carried out again";

// How far each run of the grid is, in its order.
std::vector<std::pair<std::string, RunStatus>> StatusOfAll(const fs::path& folder) {
  std::vector<std::pair<std::string, RunStatus>> all;
  for (const auto& [run_id, key] : ReadPlannedKeys(folder).keys)
    all.emplace_back(run_id, StatusOf(folder / run_id, key));
  return all;
}

// Reports show what a record says unless the experiment says otherwise, so stale ones are named.
void WriteFailures(const fs::path& folder,
                   const std::vector<std::pair<std::string, RunStatus>>& runs) {
  ExperimentRecord record = ReadExperimentRecord(folder);
  record.failed_runs.clear();
  for (const auto& [run_id, status] : runs) {
    if (status.state == RunState::kFailed) record.failed_runs[run_id] = status.reason;
    if (status.state == RunState::kStale) record.failed_runs[run_id] = kStaleReason;
  }
  WriteExperimentRecord(folder, record);
}

}  // namespace

FileLock LockExperiment(const fs::path& folder) {
  return FileLock::Wait(folder / "lock", LockKind::kExclusive);
}

void WritePlan(const Experiment& experiment, const fs::path& folder) {
  MakeFolder(folder);
  PlannedKeys plan{GetBuildInfo().build_id, {}};
  for (const PlannedRun& run : experiment.runs) plan.keys.emplace_back(run.run_id, run.key);
  const FileLock lock = LockExperiment(folder);
  WriteExperimentRecord(folder, experiment.record);
  WritePlannedKeys(folder, plan);
}

int WriteSummary(const fs::path& folder) {
  const FileLock lock = LockExperiment(folder);
  const auto runs = StatusOfAll(folder);
  WriteFailures(folder, runs);
  const ReportedExperiment experiment = ReadExperiment(folder);
  ExperimentSummary summary;
  summary.experiment = experiment.record.name;
  summary.variants = ToJson(TabulateVariants(experiment));
  for (const auto& [run_id, status] : runs) {
    if (status.state == RunState::kFailed) {
      summary.failed_runs[run_id] = status.reason;
    } else if (status.state != RunState::kDone) {
      summary.missing_runs.push_back(run_id);
    }
  }
  for (const RunRecord* run : experiment.finished()) summary.rows.push_back(run->summary);
  WriteExperimentSummary(folder, summary);
  return static_cast<int>(summary.missing_runs.size());
}

}  // namespace vitruvia
