#include "experiments/run/run_process.h"

#include "core/error.h"
#include "core/message.h"
#include "core/progress.h"
#include "core/timer.h"
#include "experiments/run/child_process.h"
#include "experiments/run/frame_failures.h"
#include "experiments/run/run_state.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

void WorkAndRecord(const RunProcess& process, const PlannedRun& run, const RunWork& work) {
  const Stopwatch watch;
  RunRecord record = work(run, process.run_folder);
  record.provenance["run"] = {
      {"wall_s", watch.ElapsedMs() / 1e3}, {"timed", run.timed}, {"jobs", process.jobs}};
  WriteRunRecord(process.run_folder.parent_path(), record);
  const FrameFailures failures = FrameFailuresOf(record.summary);
  if (failures.AreAll())
    throw RunError(
        fmt::format("all of its {} frames failed (the run's log says why)", failures.frames));
}

int CarryOut(const RunProcess& process, const RunWork& work) {
  const PlannedRun run = ReadPlannedRun(process.run_folder);
  try {
    WorkAndRecord(process, run, work);
  } catch (const std::exception& error) {
    ThrowIfInterrupted();
    MarkFailed(process.run_folder, run.key, error.what());
    return static_cast<int>(ExitCode::kFailedRun);
  }
  MarkDone(process.run_folder, run.key);
  return static_cast<int>(ExitCode::kSuccess);
}

}  // namespace

int CarryOutRun(const RunProcess& process, const RunWork& work) {
  try {
    EndWithParent(process.parent);
    return CarryOut(process, work);
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInterrupted) PrintMessage("{}\n", error.what());
    return static_cast<int>(error.code());
  }
}

}  // namespace vitruvia
