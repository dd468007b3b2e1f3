// Executes the runs of an experiment, each in its own process.
//
// Several callers may work on one folder at the same time, here or on other machines that share it:
// the caller that claims a run executes it; the others continue with the next one and wait for it
// at the end. If a caller is stopped or killed, its unfinished runs are lost; the next call
// continues.
#pragma once

#include <filesystem>
#include <vector>

#include "experiments/plan/planned_run.h"

namespace vitruvia {

struct ExperimentOutcome {
  int done = 0;    // runs carried out now
  int kept = 0;    // runs found done by this same build, or done by another caller meanwhile
  int failed = 0;  // runs that ended in an error or a crash
};

// The running program, even if its file has been replaced since it was started.
inline constexpr const char* kThisProgram = "/proc/self/exe";

// Carries out the runs that are not yet done, up to `jobs` at a time; timed runs last, one by one,
// while no other run is active on this machine. A run is `program run-one RUN_FOLDER …`
// (run_process.h). A run that fails is recorded and the others go on. Throws Error(kInterrupted)
// when the user asks to stop. The calling thread must not end during the call, because the runs
// would be killed.
ExperimentOutcome CarryOutRuns(const std::vector<PlannedRun>& runs, int jobs,
                               const std::filesystem::path& folder,
                               const std::filesystem::path& program = kThisProgram);

}  // namespace vitruvia
