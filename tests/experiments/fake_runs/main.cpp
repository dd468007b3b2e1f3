// Runs that do no work of their own, for tests of how runs are carried out.
//   fake_runs run-one FOLDER --parent PID --jobs N     one run, started as `vitruvia run` starts it
//   fake_runs carry-out FOLDER JOBS RUNS.json          another caller; prints done, kept and failed
//
// What a run does is in its settings: {"does": …, "place": folder for what the runs leave behind}.
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

#include "core/error.h"
#include "core/files.h"
#include "core/progress.h"
#include "experiments/fake_runs/fake_runs.h"
#include "experiments/run/machine_lock.h"
#include "experiments/run/run_process.h"
#include "experiments/run/run_state.h"
#include "experiments/run/runner.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;

void SleepShortly() {
  ThrowIfInterrupted();
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

void Note(const fs::path& file, const std::string& line) {
  std::ofstream(file, std::ios::app) << line + "\n";
}

std::size_t FilesIn(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

// Waits until so many runs have come here, then looks at the locks and lets the others go on when
// all have looked.
void Meet(const PlannedRun& run, const fs::path& place, const fs::path& experiment_folder) {
  const auto count = run.resolved.at("count").get<std::size_t>();
  MakeFolder(place / "here");
  MakeFolder(place / "looked");
  WriteWholeFile(place / "here" / run.run_id, "");
  while (FilesIn(place / "here") < count) SleepShortly();
  int running = 0;
  for (const auto& other : fs::directory_iterator(experiment_folder))
    running += FileLock::Held(other.path() / "lock") ? 1 : 0;
  const bool alone = !FileLock::Try(MachineLockFile(), LockKind::kShared).has_value();
  Note(place / "observations",
       fmt::format("{} running, machine {}", running, alone ? "taken" : "shared"));
  WriteWholeFile(place / "looked" / run.run_id, "");
  while (FilesIn(place / "looked") < count) SleepShortly();
}

RunRecord Work(const PlannedRun& run, const fs::path& run_folder) {
  const std::string does = run.resolved.at("does");
  const fs::path place = run.resolved.at("place").get<std::string>();
  Json summary = {{"run_id", run.run_id}};
  if (does == "throw") throw DataError("no body");
  if (does == "crash") {
    std::signal(SIGSEGV, SIG_DFL);  // whatever a sanitizer makes of it
    std::raise(SIGSEGV);
  }
  if (does == "hang") {
    MakeFolder(run_folder / ".estimate.host-1.part");  // half-written work
    WriteWholeFile(place / "reached", "");
    while (true) SleepShortly();
  }
  if (does == "meet") Meet(run, place, run_folder.parent_path());
  if (does == "share") {
    SharedWork(place).GetOrBuild([&](const fs::path& folder) {
      MakeFolder(folder);
      Note(place / "diary", "shared");
    });
  }
  if (does == "fail frames") {
    summary["frames"] = 12;
    summary["frames_failed"] = run.resolved.at("count");
  }
  Note(place / "diary", run.run_id);
  RunRecord record;
  record.run_id = run.run_id;
  record.summary = summary;
  return record;
}

int CarryOut(const fs::path& folder, int jobs, const fs::path& runs_file) {
  auto runs = ReadSettingsFile<FakeRuns>(runs_file).runs;
  for (PlannedRun& run : runs) {
    if (run.resolved.at("does") == "share")
      run.shares = SharedWork(run.resolved.at("place").get<std::string>());
  }
  const ExperimentOutcome outcome = CarryOutRuns(runs, jobs, folder);
  fmt::print("{} done, {} kept, {} failed\n", outcome.done, outcome.kept, outcome.failed);
  return 0;
}

int Main(const std::vector<std::string>& words) {
  std::signal(SIGTERM, [](int) { RequestInterrupt(); });
  try {
    if (words.at(0) == "run-one")
      return CarryOutRun({words.at(1), std::stoi(words.at(3)), std::stoi(words.at(5))}, Work);
    return CarryOut(words.at(1), std::stoi(words.at(2)), words.at(3));
  } catch (const Error& error) {
    return static_cast<int>(error.code());
  }
}

}  // namespace
}  // namespace vitruvia

int main(int argc, char** argv) { return vitruvia::Main({argv + 1, argv + argc}); }
