// Carries out the runs of an experiment, each in a process of its own.
//
// Several callers may work on one folder at the same time, here or on other machines that share it:
// the one that claims a run carries it out, the others go on with the next and wait for it at the
// end. A caller that is stopped or killed loses the runs in flight; the next call goes on.
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
// while no other run goes on on this machine. A run is `program run-one RUN_FOLDER …`
// (run_process.h). A run that fails is recorded and the others go on. Throws Error(kInterrupted)
// when the user asks to stop. The calling thread must outlive the call, for runs are killed when it
// ends.
ExperimentOutcome CarryOutRuns(const std::vector<PlannedRun>& runs, int jobs,
                               const std::filesystem::path& folder,
                               const std::filesystem::path& program = kThisProgram);

}  // namespace vitruvia
