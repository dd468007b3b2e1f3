// Carries out the runs of an experiment, each in a process of its own.
//
// Several callers may work on one folder at the same time, here or on other machines that share it:
// whoever claims a run carries it out, the others go on with the next and wait for it at the end.
// A caller that is stopped or killed loses the runs in flight; the next one goes on.
#pragma once

#include <filesystem>
#include <vector>

#include "core/file_lock.h"
#include "experiments/plan/planned_run.h"

namespace vitruvia {

struct ExperimentOutcome {
  int done = 0;    // runs carried out now
  int kept = 0;    // runs found done by this same build, or done by another caller meanwhile
  int failed = 0;  // runs that ended in an error or a crash
};

// Who writes files that speak of the whole experiment holds this lock meanwhile.
FileLock LockExperiment(const std::filesystem::path& folder);

// Writes what status and report need to know of the whole grid: experiment.json and plan.json.
void WritePlan(const Experiment& experiment, const std::filesystem::path& folder);

// Carries out whatever of `runs` is not yet done, up to `jobs` at a time; timed runs last, one by
// one, while no other run of this user goes on on this machine. A run that fails is recorded and
// the others go on. Throws Error(kInterrupted) if a stop was asked for.
ExperimentOutcome CarryOutRuns(const std::vector<PlannedRun>& runs, int jobs,
                               const std::filesystem::path& folder);

// Writes experiment.json and summary.json anew, from what lies in the folder: whoever ends last
// writes the same. Returns how many runs of the grid are neither done nor failed.
int WriteSummary(const std::filesystem::path& folder);

}  // namespace vitruvia
