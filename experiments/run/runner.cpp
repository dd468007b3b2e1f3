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
#include "experiments/run/child_process.h"
#include "experiments/run/machine_lock.h"
#include "experiments/run/run_state.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr std::chrono::milliseconds kLookAgainAfter{20};

// Where and how runs are carried out.
struct Site {
  int jobs;
  fs::path folder, program;
};

class Scheduler {
 public:
  Scheduler(std::vector<const PlannedRun*> runs, Site site, const FileLock& machine)
      : runs_(std::move(runs)), site_(std::move(site)), machine_(machine) {
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
    std::string prepares;  // the shared work that the run does first; "" if that was done before
  };

  // Does not examine runs while all jobs are busy, because that would disturb time measurements.
  void StartWhatCanBe() {
    std::erase_if(pending_, [this](std::size_t i) {
      return children_.running() < site_.jobs && (Settled(i) || Started(i));
    });
  }

  // Whether the run is finished: done before or, meanwhile, by another process.
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
    try {
      Begin(i, std::move(*claim));
    } catch (const RunError& error) {  // a full disk, say
      CountFailure(run, error.what());
    }
    return true;
  }

  void Begin(std::size_t i, FileLock claim) {
    const PlannedRun& run = *runs_[i];
    MarkBegun(FolderOf(i));
    RemoveUnfinished(FolderOf(i) / "estimate");
    WritePlannedRun(FolderOf(i), run);
    PrintMessage("run {}/{}: {}\n", i + 1, runs_.size(), run.run_id);
    const bool prepares = run.shares && !run.shares->complete();
    // The locks last as long as the child, even if this process is killed.
    children_.Start(static_cast<int>(i), CommandOf(i, {claim.descriptor(), machine_.descriptor()}));
    in_flight_.emplace(
        i, InFlight{std::move(claim), prepares ? run.shares->path().string() : std::string()});
  }

  ChildCommand CommandOf(std::size_t i, std::vector<int> locks) const {
    ChildCommand command{site_.program,
                         {"run-one", FolderOf(i).string(), "--parent", std::to_string(getpid()),
                          "--jobs", std::to_string(site_.jobs)},
                         {},
                         std::move(locks)};
    if (site_.jobs > 1) {
      command.messages = FolderOf(i) / "messages";
      fs::remove(command.messages);
    }
    return command;
  }

  // Another run does the shared work now, and this one would only wait for it.
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
      const std::string reason = StatusOf(FolderOf(i), run.key).reason;
      CountFailure(run, reason.empty() ? "no status could be written" : reason);
    }
  }

  void CountFailure(const PlannedRun& run, const std::string& reason) {
    ++outcome_.failed;
    PrintMessage("run failed: {}: {}\n", run.run_id, reason);
  }

  void NoteElsewhere(std::size_t i) {
    if (elsewhere_.insert(i).second)
      PrintMessage("another process carries out {}\n", runs_[i]->run_id);
  }

  fs::path FolderOf(std::size_t i) const { return site_.folder / runs_[i]->run_id; }

  std::vector<const PlannedRun*> runs_;
  Site site_;
  const FileLock& machine_;
  std::vector<std::size_t> pending_;
  std::set<std::size_t> elsewhere_;  // runs that another process was seen to carry out
  ExperimentOutcome outcome_;
  std::map<std::size_t, InFlight> in_flight_;
  ChildProcesses children_;  // destroyed first, so that claims outlive the children
};

ExperimentOutcome CarryOutPhase(const std::vector<PlannedRun>& runs, bool timed, const Site& site) {
  std::vector<const PlannedRun*> chosen;
  for (const PlannedRun& run : runs) {
    if (run.timed == timed) chosen.push_back(&run);
  }
  if (chosen.empty()) return {};
  const FileLock machine = LockMachine(timed ? LockKind::kExclusive : LockKind::kShared);
  return Scheduler(chosen, site, machine).Work();
}

}  // namespace

ExperimentOutcome CarryOutRuns(const std::vector<PlannedRun>& runs, int jobs,
                               const fs::path& folder, const fs::path& program) {
  MakeFolder(folder);
  const ExperimentOutcome parallel = CarryOutPhase(runs, false, {jobs, folder, program});
  const ExperimentOutcome timed = CarryOutPhase(runs, true, {1, folder, program});
  return {parallel.done + timed.done, parallel.kept + timed.kept, parallel.failed + timed.failed};
}

}  // namespace vitruvia
