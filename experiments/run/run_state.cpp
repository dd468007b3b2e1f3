#include "experiments/run/run_state.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "core/files.h"
#include "records/estimate.h"
#include "records/run_record.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kStatusFile = "status";
constexpr const char* kLockFile = "lock";
constexpr const char* kPlanFile = "plan.json";

std::string DoneText(const std::string& key) { return fmt::format("done {}\n", key); }
std::string FailedHead(const std::string& key) { return fmt::format("failed {}\n", key); }

std::string StatusText(const fs::path& run_folder) {
  try {
    return ReadWholeFile(run_folder / kStatusFile);
  } catch (const DataError&) {
    return "";  // not there, or removed at this moment by a process that begins the run
  }
}

RunStatus StatusOfDone(const fs::path& run_folder) {
  try {
    const RunRecord record =
        ReadRunRecord(run_folder.parent_path(), run_folder.filename().string());
    if (std::string missing = MissingEstimateFile(run_folder / "estimate"); !missing.empty())
      return {RunState::kDamaged, std::move(missing), {}};
    return {RunState::kDone, "", FrameFailuresOf(record.summary)};
  } catch (const DataError& error) {
    return {RunState::kDamaged, error.what(), {}};
  }
}

std::string WithoutLastNewline(std::string text) {
  if (text.ends_with('\n')) text.pop_back();
  return text;
}

}  // namespace

const char* Name(RunState state) {
  switch (state) {
    case RunState::kDone:
      return "done";
    case RunState::kFailed:
      return "failed";
    case RunState::kDamaged:
      return "damaged";
    case RunState::kStale:
      return "stale";
    case RunState::kRunning:
      return "running";
    case RunState::kMissing:
      break;
  }
  return "missing";
}

RunStatus StatusOf(const fs::path& run_folder, const std::string& key) {
  const std::string text = StatusText(run_folder);
  if (text == DoneText(key)) return StatusOfDone(run_folder);
  if (FileLock::Held(run_folder / kLockFile)) return {RunState::kRunning, "", {}};
  const std::string head = FailedHead(key);
  if (text.starts_with(head))
    return {RunState::kFailed, WithoutLastNewline(text.substr(head.size())), {}};
  return {text.empty() ? RunState::kMissing : RunState::kStale, "", {}};
}

void MarkDone(const fs::path& run_folder, const std::string& key) {
  WriteWholeFile(run_folder / kStatusFile, DoneText(key));
}

void MarkFailed(const fs::path& run_folder, const std::string& key, const std::string& reason) {
  WriteWholeFile(run_folder / kStatusFile, FailedHead(key) + reason + "\n");
}

void MarkBegun(const fs::path& run_folder) { fs::remove(run_folder / kStatusFile); }

std::optional<FileLock> ClaimRun(const fs::path& run_folder) {
  MakeFolder(run_folder);
  return FileLock::Try(run_folder / kLockFile, LockKind::kExclusive);
}

std::vector<fs::path> OldRunFolders(const fs::path& experiment_folder, const StoredPlan& plan) {
  std::vector<fs::path> old;
  if (!fs::is_directory(experiment_folder)) return old;
  for (const auto& entry : fs::directory_iterator(experiment_folder)) {
    const fs::path& folder = entry.path();
    const bool is_run = fs::exists(folder / "run.json") || fs::exists(folder / "record.json");
    const bool is_planned = std::any_of(
        plan.runs.begin(), plan.runs.end(),
        [&](const StoredPlan::Run& run) { return run.run_id == folder.filename().string(); });
    if (is_run && !is_planned && !FileLock::Held(folder / kLockFile)) old.push_back(folder);
  }
  std::sort(old.begin(), old.end());
  return old;
}

void StoredPlan::Run::Describe(Fields& f) {
  f.Text("run_id", run_id, {.meaning = "identity of the run"});
  f.Text("key", key, {.meaning = "hash of everything that the run's result depends on"});
}

void StoredPlan::Describe(Fields& f) {
  f.Text("build_id", build_id, {.meaning = "linked identity of the program that planned"});
  f.File("experiment_file", experiment_file, {.meaning = "experiment file that was planned"});
  f.Number("failed_frames_limit", failed_frames_limit,
           {.meaning = "share of a run's frames that may fail"});
  f.List("runs", runs, {.meaning = "the runs, in the order of the grid"});
}

void StoredPlan::Upgrade(Json& file, int /*version*/) {
  if (!file.is_object()) return;
  file.emplace("experiment_file", "");
  file.emplace("failed_frames_limit", 1.0);
}

void WriteStoredPlan(const fs::path& experiment_folder, const StoredPlan& plan) {
  StoredPlan stored = plan;
  if (!plan.experiment_file.empty())  // so that the folder can move together with the file
    stored.experiment_file = fs::absolute(plan.experiment_file)
                                 .lexically_normal()
                                 .lexically_relative(fs::absolute(experiment_folder));
  WriteStored(experiment_folder / kPlanFile, stored);
}

StoredPlan ReadStoredPlan(const fs::path& experiment_folder) {
  return ReadStored<StoredPlan>(experiment_folder / kPlanFile);
}

}  // namespace vitruvia
