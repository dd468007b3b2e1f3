#include "experiments/cli/experiment_folder.h"

#include <CLI/CLI.hpp>

#include "core/error.h"
#include "experiments/plan/experiment_config.h"
#include "experiments/studies/planned_experiment.h"

namespace vitruvia {
namespace fs = std::filesystem;

fs::path ExperimentFolder(const fs::path& experiment, const fs::path& output) {
  if (!fs::is_regular_file(experiment)) {
    if (!output.empty())
      throw ConfigError(
          fmt::format("{}: expected an experiment file, since -o names the folder of its output",
                      experiment.string()));
    return experiment;  // who reads it says what is missing there
  }
  const fs::path folder = OutputFolder(experiment, output);
  if (fs::exists(folder / "experiment.json")) return folder;
  throw ConfigError(fmt::format("{}: nothing has been run yet: there is no {}; vitruvia run {}",
                                experiment.string(), (folder / "experiment.json").string(),
                                experiment.string()));
}

void AddExperimentArgument(CLI::App& command, fs::path& experiment, fs::path& output) {
  command.add_option("EXPERIMENT", experiment, "experiment file, or the folder of its output")
      ->required();
  command.add_option("-o,--output", output,
                     "the folder of an experiment file's output; without it out/NAME");
}

}  // namespace vitruvia
