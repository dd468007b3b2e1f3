#include "experiments/run/experiment_files.h"

#include "analysis/variant_comparison.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/files.h"
#include "experiments/run/run_state.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kStaleReason =
    "stale: made with other settings or by another build, and not carried out again";

using RunStatuses = std::vector<std::pair<std::string, RunStatus>>;  // in the grid's order

RunStatuses StatusOfAll(const fs::path& folder) {
  RunStatuses all;
  for (const auto& [run_id, key] : ReadStoredPlan(folder).runs)
    all.emplace_back(run_id, StatusOf(folder / run_id, key));
  return all;
}

// Reports show every record that is there, so runs whose record does not count are named.
void WriteFailures(const fs::path& folder, const RunStatuses& runs) {
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

void RequireOwnFolder(const fs::path& folder, const fs::path& experiment_file) {
  StoredPlan plan;
  try {
    plan = ReadStoredPlan(folder);
  } catch (const DataError&) {
    return;  // nothing planned yet, or nothing that can be read
  }
  std::error_code gone;
  const bool is_other = fs::is_regular_file(plan.experiment_file, gone) &&
                        !fs::equivalent(plan.experiment_file, experiment_file, gone);
  if (!is_other) return;
  throw ConfigError(fmt::format(
      "{}: holds the output of another experiment file, {}; expected a folder of its own for {}: "
      "name one with -o",
      folder.string(), plan.experiment_file.string(), experiment_file.string()));
}

void WritePlan(const Experiment& experiment, const fs::path& experiment_file,
               const fs::path& folder) {
  MakeFolder(folder);
  StoredPlan plan{GetBuildInfo().build_id, experiment_file, experiment.failed_frames_limit, {}};
  for (const PlannedRun& run : experiment.runs) plan.runs.push_back({run.run_id, run.key});
  const FileLock lock = LockExperiment(folder);
  WriteExperimentRecord(folder, experiment.record);
  WriteStoredPlan(folder, plan);
}

int WriteSummary(const fs::path& folder) {
  const FileLock lock = LockExperiment(folder);
  const RunStatuses runs = StatusOfAll(folder);
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
