#include "experiments/run/run_state.h"

#include <fmt/format.h>

#include "config/json_node.h"
#include "core/error.h"
#include "core/files.h"

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
  nlohmann::json runs = nlohmann::json::array();
  for (const auto& [run_id, key] : plan.keys) runs.push_back({{"run_id", run_id}, {"key", key}});
  WriteWholeFile(experiment_folder / kPlanFile,
                 nlohmann::json{{"build_id", plan.build_id}, {"runs", runs}}.dump(1) + "\n");
}

PlannedKeys ReadPlannedKeys(const fs::path& experiment_folder) {
  const fs::path file = experiment_folder / kPlanFile;
  const nlohmann::json json = ReadStoredJson(file);
  const JsonNode node(json, file.string());
  return {node.At("build_id").Text(), node.At("runs").List([](const JsonNode& run) {
            return std::pair(run.At("run_id").Text(), run.At("key").Text());
          })};
}

}  // namespace vitruvia
