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

using RunKeys = std::vector<std::pair<std::string, std::string>>;  // run id and key

void PrintStatus(const fs::path& folder, const RunKeys& runs) {
  std::map<RunState, int> count;
  for (const auto& [run_id, key] : runs) {
    const RunStatus status = StatusOf(folder / run_id, key);
    ++count[status.state];
    fmt::print("{:<8} {}{}\n", Name(status.state), run_id,
               status.reason.empty() ? "" : ": " + status.reason);
  }
  fmt::print("{}: {} runs", folder.string(), runs.size());
  for (const auto& [state, runs_of_state] : count)
    fmt::print(", {} {}", runs_of_state, Name(state));
  fmt::print("\n");
}

// What the experiment file means now, to this build.
void PrintStatusOfPlan(const fs::path& experiment_file, const fs::path& output) {
  const PlannedExperiment plan = PlanForOutput(experiment_file, output);
  RunKeys runs;
  for (const PlannedRun& run : plan.experiment.runs) runs.emplace_back(run.run_id, run.key);
  PrintStatus(plan.folder, runs);
}

// What it meant when the folder was last written to.
void PrintStatusOfFolder(const fs::path& folder) {
  const PlannedKeys plan = ReadPlannedKeys(folder);
  if (plan.build_id != GetBuildInfo().build_id) {
    fmt::print("planned by another build of vitruvia: to this one all of it is stale\n");
  }
  PrintStatus(folder, plan.keys);
}

}  // namespace

void AddStatusCommand(CLI::App& app) {
  struct StatusArguments {
    fs::path experiment, output;
  };
  auto a = std::make_shared<StatusArguments>();
  CLI::App* status = app.add_subcommand(
      "status", "Say which runs of an experiment are done, failed, stale, running or missing");
  status->add_option("EXPERIMENT", a->experiment, "experiment file, or an experiment's folder")
      ->required();
  status->add_option("-o,--output", a->output, "the experiment's folder; out/NAME without");
  status->callback([a] {
    if (!fs::is_directory(a->experiment)) return PrintStatusOfPlan(a->experiment, a->output);
    if (!a->output.empty())
      throw ConfigError(
          "status: expected an experiment's folder, or an experiment file and -o DIR");
    PrintStatusOfFolder(a->experiment);
  });
}

}  // namespace vitruvia
