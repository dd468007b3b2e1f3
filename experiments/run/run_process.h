// The process that carries out one run: `vitruvia run-one`.
#pragma once

#include <filesystem>
#include <functional>
#include <sys/types.h>

#include "experiments/plan/planned_run.h"

namespace vitruvia {

// Executes one run; may write any files into the run's folder.
using RunWork =
    std::function<RunRecord(const PlannedRun& run, const std::filesystem::path& run_folder)>;

struct RunProcess {
  std::filesystem::path run_folder;
  pid_t parent = 0;  // the process that started this one, and holds the run's lock
  int jobs = 1;      // number of concurrent runs
};

// Reads run.json, does the work, and leaves the record and the status in the run's folder. Returns
// the exit code: kSuccess, kFailedRun (the status says why) or kInterrupted (there is no status).
int CarryOutRun(const RunProcess& process, const RunWork& work);

}  // namespace vitruvia
