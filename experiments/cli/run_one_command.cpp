#include "experiments/cli/run_one_command.h"

#include <memory>

#include <CLI/CLI.hpp>

#include "experiments/run/run_process.h"
#include "experiments/studies/experiment_kinds.h"

namespace vitruvia {

void AddRunOneCommand(CLI::App& app) {
  const auto a = std::make_shared<RunProcess>();
  CLI::App* command = app.add_subcommand(
      "run-one", "Execute one run; `vitruvia run` starts this command for each run");
  command->group("");  // not for people: it takes no locks of its own
  command->add_option("FOLDER", a->run_folder, "the run's folder, with its run.json")->required();
  command->add_option("--parent", a->parent, "process id of the `vitruvia run` that starts it")
      ->required();
  command->add_option("--jobs", a->jobs, "number of concurrent runs")->required();
  command->callback([a] {
    const int code = CarryOutRun(*a, CarryOutAnyRun);
    if (code != 0) throw CLI::RuntimeError(code);
  });
}

}  // namespace vitruvia
