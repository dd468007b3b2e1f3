#include "experiments/cli/status_command.h"

#include <map>
#include <memory>

#include <CLI/CLI.hpp>

#include "core/build_info.h"
#include "core/error.h"
#include "experiments/run/run_state.h"
#include "experiments/studies/planned_experiment.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kStatusFooter =
    "Exit codes: 0 no run failed; 4 a run failed; 8 no run failed, but in some run more frames "
    "failed\n"
    "than failed_frames_limit allows (vitruvia explain experiment.failed_frames_limit).";

std::string NoteOn(const RunStatus& status, double limit) {
  if (status.failures.AreMoreThan(limit)) return ": " + status.failures.Text(limit);
  return status.reason.empty() ? "" : ": " + status.reason;
}

// Lists or removes the runs that the experiment no longer contains.
void HandleOldRuns(const fs::path& folder, const StoredPlan& plan, bool prune) {
  const std::vector<fs::path> old = OldRunFolders(folder, plan);
  for (const fs::path& run : old) {
    if (prune) fs::remove_all(run);
    fmt::print("{:<8} {}\n", prune ? "removed" : "old", run.filename().string());
  }
  if (!old.empty() && !prune)
    fmt::print("{} old runs, of settings that the experiment no longer has; --prune removes them\n",
               old.size());
}

void PrintStatus(const fs::path& folder, const StoredPlan& plan, bool prune) {
  std::map<RunState, int> count;
  int doubtful = 0;
  for (const auto& [run_id, key] : plan.runs) {
    const RunStatus status = StatusOf(folder / run_id, key);
    ++count[status.state];
    if (status.failures.AreMoreThan(plan.failed_frames_limit)) ++doubtful;
    fmt::print("{:<8} {}{}\n", Name(status.state), run_id,
               NoteOn(status, plan.failed_frames_limit));
  }
  HandleOldRuns(folder, plan, prune);
  fmt::print("{}: {} runs", folder.string(), plan.runs.size());
  for (const auto& [state, runs_of_state] : count)
    fmt::print(", {} {}", runs_of_state, Name(state));
  fmt::print("\n");
  if (count[RunState::kFailed] > 0)
    throw RunError(fmt::format("{} runs failed", count[RunState::kFailed]));
  if (doubtful > 0)
    throw Error(ExitCode::kFramesFailed,
                fmt::format("too many frames failed in {} runs", doubtful));
}

// Prints the status of the experiment file's current plan with this build.
void PrintStatusOfFile(const fs::path& experiment_file, const fs::path& output, bool prune) {
  const PlannedExperiment planned = PlanForOutput(experiment_file, output);
  StoredPlan plan;
  plan.failed_frames_limit = planned.experiment.failed_frames_limit;
  for (const PlannedRun& run : planned.experiment.runs) plan.runs.push_back({run.run_id, run.key});
  PrintStatus(planned.folder, plan, prune);
}

// Prints the status of the folder's stored plan.
void PrintStatusOfFolder(const fs::path& folder, bool prune) {
  const StoredPlan plan = ReadStoredPlan(folder);
  if (plan.build_id != GetBuildInfo().build_id)
    fmt::print("planned by another build of vitruvia, to which all of its runs are stale\n");
  PrintStatus(folder, plan, prune);
}

}  // namespace

void AddStatusCommand(CLI::App& app) {
  struct StatusArguments {
    fs::path experiment, output;
    bool prune = false;
  };
  auto a = std::make_shared<StatusArguments>();
  CLI::App* status = app.add_subcommand(
      "status",
      "Print which runs of an experiment are done, failed, damaged, stale, running or missing");
  status->footer(kStatusFooter);
  status->add_option("EXPERIMENT", a->experiment, "experiment file, or an experiment's folder")
      ->required();
  status->add_option("-o,--output", a->output, "the experiment's folder; without it out/NAME");
  status->add_flag("--prune", a->prune,
                   "remove the folders of runs that the experiment no longer contains");
  status->callback([a] {
    if (!fs::is_directory(a->experiment))
      return PrintStatusOfFile(a->experiment, a->output, a->prune);
    if (!a->output.empty())
      throw ConfigError(
          "status: expected an experiment's folder, or an experiment file and -o DIR");
    PrintStatusOfFolder(a->experiment, a->prune);
  });
}

}  // namespace vitruvia
