// How far the runs of an experiment are: read from their folders, by any process at any time.
//
//   <run id>/status   "done KEY" or "failed KEY" and the reason; absent: not carried out
//   <run id>/lock     locked by the process that carries the run out
//   <run id>/messages what a run prints that goes on beside others
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/file_lock.h"

namespace vitruvia {

enum class RunState {
  kDone,     // by this program, from these settings and files
  kFailed,   // so, too; it is tried again by the next call
  kStale,    // done or failed, but with other settings, files or by another build
  kRunning,  // some process is at it
  kMissing,  // not carried out, or interrupted
};
const char* Name(RunState state);

struct RunStatus {
  RunState state = RunState::kMissing;
  std::string reason;  // of a failure
};

// `key`: what the run's result depends on (CacheKey, build_cache.h).
RunStatus StatusOf(const std::filesystem::path& run_folder, const std::string& key);

void MarkDone(const std::filesystem::path& run_folder, const std::string& key);
void MarkFailed(const std::filesystem::path& run_folder, const std::string& key,
                const std::string& reason);
void MarkBegun(const std::filesystem::path& run_folder);  // no longer done nor failed

// The right to carry out a run; nothing while another process has it.
std::optional<FileLock> ClaimRun(const std::filesystem::path& run_folder);

// The runs that an experiment's folder was last planned for (plan.json), so that its state can be
// told without the experiment file.
struct PlannedKeys {
  std::string build_id;                                   // of the program that planned
  std::vector<std::pair<std::string, std::string>> keys;  // run id and key, in the grid's order
};
void WritePlannedKeys(const std::filesystem::path& experiment_folder, const PlannedKeys& plan);
// DataError if there is none or it is damaged.
PlannedKeys ReadPlannedKeys(const std::filesystem::path& experiment_folder);

}  // namespace vitruvia
