#include "experiments/run/run_state.h"

#include <fmt/format.h>

#include "config/stored_data.h"
#include "core/error.h"
#include "core/files.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kStatusFile = "status";
constexpr const char* kLockFile = "lock";
constexpr const char* kPlanFile = "plan.json";

struct PlannedKey {
  std::string run_id, key;

  void Describe(Fields& f) {
    f.Text("run_id", run_id, {.meaning = "identity of the run"});
    f.Text("key", key, {.meaning = "hash of everything that the run's result depends on"});
  }
};

struct PlanFile {
  static constexpr StoredFormat kFormat{"vitruvia-plan", 1, 0, "run the experiment again"};

  std::string build_id;
  std::vector<PlannedKey> runs;

  void Describe(Fields& f) {
    f.Text("build_id", build_id, {.meaning = "linked identity of the program that planned"});
    f.List("runs", runs, {.meaning = "the runs, in the order of the grid"});
  }
};

std::string DoneText(const std::string& key) { return fmt::format("done {}\n", key); }
std::string FailedHead(const std::string& key) { return fmt::format("failed {}\n", key); }

std::string StatusText(const fs::path& run_folder) {
  try {
    return ReadWholeFile(run_folder / kStatusFile);
  } catch (const DataError&) {
    return "";  // not there, or taken away by who begins the run at this moment
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
  if (text == DoneText(key)) return {RunState::kDone, ""};
  if (FileLock::Held(run_folder / kLockFile)) return {RunState::kRunning, ""};
  const std::string head = FailedHead(key);
  if (text.starts_with(head))
    return {RunState::kFailed, WithoutLastNewline(text.substr(head.size()))};
  return {text.empty() ? RunState::kMissing : RunState::kStale, ""};
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

void WritePlannedKeys(const fs::path& experiment_folder, const PlannedKeys& plan) {
  PlanFile file{plan.build_id, {}};
  for (const auto& [run_id, key] : plan.keys) file.runs.push_back({run_id, key});
  WriteStored(experiment_folder / kPlanFile, file);
}

PlannedKeys ReadPlannedKeys(const fs::path& experiment_folder) {
  const auto file = ReadStored<PlanFile>(experiment_folder / kPlanFile);
  PlannedKeys plan{file.build_id, {}};
  for (const PlannedKey& run : file.runs) plan.keys.emplace_back(run.run_id, run.key);
  return plan;
}

}  // namespace vitruvia
