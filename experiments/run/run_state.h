// The state of each run of an experiment, read from its folder by any process at any time.
//
//   <run id>/run.json  the run's settings (planned_run.h)
//   <run id>/status    "done KEY" or "failed KEY" and the reason; absent: not carried out
//   <run id>/lock      locked while a process carries out the run
//   <run id>/messages  standard error of a run that is carried out beside others
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/stored_data.h"
#include "core/file_lock.h"
#include "experiments/run/frame_failures.h"

namespace vitruvia {

enum class RunState {
  kDone,     // by this program, with these settings and files
  kFailed,   // by this program, with these settings and files; the next call of `run` tries it
             // again
  kDamaged,  // done, but its record cannot be read any more or a file of its estimate is gone
  kStale,    // done or failed with other settings or files, or by another build
  kRunning,  // a process carries it out now
  kMissing,  // not carried out, or interrupted
};
const char* Name(RunState state);

struct RunStatus {
  RunState state = RunState::kMissing;
  std::string reason;      // of a failed or damaged run
  FrameFailures failures;  // of a run that is done
};

// `key`: hash of all that the run's result depends on (CacheKey, build_cache.h).
RunStatus StatusOf(const std::filesystem::path& run_folder, const std::string& key);

void MarkDone(const std::filesystem::path& run_folder, const std::string& key);
void MarkFailed(const std::filesystem::path& run_folder, const std::string& key,
                const std::string& reason);
void MarkBegun(const std::filesystem::path& run_folder);  // removes the marks "done" and "failed"

// Claims the exclusive right to execute a run; nothing if another process holds it.
std::optional<FileLock> ClaimRun(const std::filesystem::path& run_folder);

// The last plan of an experiment's folder (plan.json), from which its state can be read without the
// experiment file.
struct StoredPlan {
  static constexpr StoredFormat kFormat{"vitruvia-plan", 1, 0, "run the experiment again"};

  struct Run {
    std::string run_id, key;
    void Describe(Fields& fields);
  };
  std::string build_id;                   // of the program that planned
  std::filesystem::path experiment_file;  // "" in plans of older programs
  double failed_frames_limit = 1.0;
  std::vector<Run> runs;  // in the grid's order

  void Describe(Fields& fields);
  static void Upgrade(Json& file, int version);
};
// Folders of runs that the experiment no longer has, since its file was changed: each has a
// run.json or a record.json, and no process carries it out. In order of their names.
std::vector<std::filesystem::path> OldRunFolders(const std::filesystem::path& experiment_folder,
                                                 const StoredPlan& plan);

void WriteStoredPlan(const std::filesystem::path& experiment_folder, const StoredPlan& plan);
// DataError if there is none or it is damaged.
StoredPlan ReadStoredPlan(const std::filesystem::path& experiment_folder);

}  // namespace vitruvia
