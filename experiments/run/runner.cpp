#include "experiments/run/runner.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <set>
#include <thread>
#include <unistd.h>

#include "core/error.h"
#include "core/files.h"
#include "core/message.h"
#include "core/progress.h"
#include "core/timer.h"
#include "experiments/run/child_process.h"
#include "experiments/run/run_state.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr std::chrono::milliseconds kLookAgainAfter{20};

// Held shared by whoever carries out runs on this machine, and alone by whoever times them.
FileLock LockMachine(LockKind kind) {
  const fs::path file = fs::temp_directory_path() / fmt::format("vitruvia-runs-{}.lock", getuid());
  if (std::optional<FileLock> lock = FileLock::Try(file, kind)) return std::move(*lock);
  PrintMessage("waiting: timed runs go alone on their machine, and others are going on\n");
  return FileLock::Wait(file, kind);
}

// In the run's own process: carries it out and leaves record and status behind.
int CarryOutOne(const PlannedRun& run, int jobs, const fs::path& folder) {
  const fs::path run_folder = folder / run.run_id;
  try {
    try {
      const Stopwatch watch;
      RunRecord record = run.carry_out(run_folder);
      record.provenance["run"] = {
          {"wall_s", watch.ElapsedMs() / 1e3}, {"timed", run.timed}, {"jobs", jobs}};
      WriteRunRecord(folder, record);
      MarkDone(run_folder, run.key);
      return static_cast<int>(ExitCode::kSuccess);
    } catch (const std::exception& error) {
      ThrowIfInterrupted();
      MarkFailed(run_folder, run.key, error.what());
      return static_cast<int>(ExitCode::kFailedRun);
    }
  } catch (const Error& error) {
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    PrintMessage("{}\n", error.what());
    return static_cast<int>(ExitCode::kInternalError);
  }
}

class Scheduler {
 public:
  Scheduler(std::vector<const PlannedRun*> runs, int jobs, fs::path folder)
      : runs_(std::move(runs)), jobs_(jobs), folder_(std::move(folder)) {
    for (std::size_t i = 0; i < runs_.size(); ++i) pending_.push_back(i);
  }

  ExperimentOutcome Work() {
    while (!pending_.empty() || children_.running() > 0) {
      CollectEnded();
      StartWhatCanBe();
      ThrowIfInterrupted();
      std::this_thread::sleep_for(kLookAgainAfter);
    }
    return outcome_;
  }

 private:
  struct InFlight {
    FileLock claim;
    std::string prepares;  // the shared work that it has to do first; "" if that was done
  };

  // Looks at no run while all jobs are taken: asking has to be cheap, for times are being measured.
  void StartWhatCanBe() {
    std::erase_if(pending_, [this](std::size_t i) {
      return children_.running() < jobs_ && (Settled(i) || Started(i));
    });
  }

  // Whether the run needs nothing more: done before or, while we waited, by another process.
  bool Settled(std::size_t i) {
    const RunStatus status = StatusOf(FolderOf(i), runs_[i]->key);
    if (status.state == RunState::kDone) ++outcome_.kept;
    const bool failed_elsewhere = status.state == RunState::kFailed && elsewhere_.contains(i);
    if (failed_elsewhere) ++outcome_.failed;
    if (status.state == RunState::kRunning) NoteElsewhere(i);
    return status.state == RunState::kDone || failed_elsewhere;
  }

  bool Started(std::size_t i) {
    const PlannedRun& run = *runs_[i];
    if (IsBeingPrepared(run)) return false;
    std::optional<FileLock> claim = ClaimRun(FolderOf(i));
    if (!claim) NoteElsewhere(i);
    if (!claim || StatusOf(FolderOf(i), run.key).state == RunState::kDone) return false;
    Begin(i, std::move(*claim));
    return true;
  }

  void Begin(std::size_t i, FileLock claim) {
    const PlannedRun& run = *runs_[i];
    const fs::path messages = jobs_ > 1 ? FolderOf(i) / "messages" : fs::path();
    MarkBegun(FolderOf(i));
    RemoveUnfinished(FolderOf(i) / "estimate");
    if (!messages.empty()) fs::remove(messages);
    PrintMessage("run {}/{}: {}\n", i + 1, runs_.size(), run.run_id);
    const bool prepares = run.shares && !run.shares->complete();
    in_flight_.emplace(
        i, InFlight{std::move(claim), prepares ? run.shares->path().string() : std::string()});
    children_.Start(static_cast<int>(i), messages,
                    [&run, this] { return CarryOutOne(run, jobs_, folder_); });
  }

  // A second run would only wait while the first does what they share.
  bool IsBeingPrepared(const PlannedRun& run) const {
    return run.shares && !run.shares->complete() &&
           std::any_of(in_flight_.begin(), in_flight_.end(), [&run](const auto& item) {
             return item.second.prepares == run.shares->path().string();
           });
  }

  void CollectEnded() {
    for (const ChildProcesses::End& end : children_.TakeEnded()) {
      const auto i = static_cast<std::size_t>(end.id);
      const PlannedRun& run = *runs_[i];
      if (!end.problem.empty()) MarkFailed(FolderOf(i), run.key, end.problem);
      in_flight_.erase(i);  // the claim ends
      if (end.code == static_cast<int>(ExitCode::kInterrupted)) ThrowIfInterrupted();
      if (end.code == static_cast<int>(ExitCode::kSuccess)) {
        ++outcome_.done;
        continue;
      }
      ++outcome_.failed;
      const std::string reason = StatusOf(FolderOf(i), run.key).reason;
      PrintMessage("run failed: {}: {}\n", run.run_id,
                   reason.empty() ? "no status could be written" : reason);
    }
  }

  void NoteElsewhere(std::size_t i) {
    if (elsewhere_.insert(i).second) PrintMessage("another process is at {}\n", runs_[i]->run_id);
  }

  fs::path FolderOf(std::size_t i) const { return folder_ / runs_[i]->run_id; }

  std::vector<const PlannedRun*> runs_;
  int jobs_;
  fs::path folder_;
  std::vector<std::size_t> pending_;
  std::set<std::size_t> elsewhere_;  // those that another process was seen at
  ExperimentOutcome outcome_;
  std::map<std::size_t, InFlight> in_flight_;
  ChildProcesses children_;  // goes first, so that claims outlive the children
};

ExperimentOutcome CarryOutPhase(const std::vector<PlannedRun>& runs, bool timed, int jobs,
                                const fs::path& folder) {
  std::vector<const PlannedRun*> chosen;
  for (const PlannedRun& run : runs) {
    if (run.timed == timed) chosen.push_back(&run);
  }
  if (chosen.empty()) return {};
  const FileLock machine = LockMachine(timed ? LockKind::kExclusive : LockKind::kShared);
  return Scheduler(chosen, timed ? 1 : jobs, folder).Work();
}

}  // namespace

ExperimentOutcome CarryOutRuns(const std::vector<PlannedRun>& runs, int jobs,
                               const fs::path& folder) {
  MakeFolder(folder);
  const ExperimentOutcome parallel = CarryOutPhase(runs, false, jobs, folder);
  const ExperimentOutcome timed = CarryOutPhase(runs, true, jobs, folder);
  return {parallel.done + timed.done, parallel.kept + timed.kept, parallel.failed + timed.failed};
}

}  // namespace vitruvia
