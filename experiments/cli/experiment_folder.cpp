#include "experiments/cli/experiment_folder.h"

#include <CLI/CLI.hpp>

#include "core/error.h"
#include "core/pattern.h"
#include "experiments/run/experiment_files.h"
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
  if (fs::exists(folder / "experiment.json")) {
    RequireOwnFolder(folder, experiment);
    return folder;
  }
  throw ConfigError(fmt::format("{}: nothing has been run yet: there is no {}; vitruvia run {}",
                                experiment.string(), (folder / "experiment.json").string(),
                                experiment.string()));
}

std::vector<std::string> RunsMatching(const ExperimentRecord& experiment, const std::string& only) {
  std::vector<std::string> runs = experiment.run_ids;
  if (only.empty()) return runs;
  std::erase_if(runs, [&](const std::string& run_id) { return !MatchesPattern(only, run_id); });
  if (runs.empty() && !experiment.run_ids.empty())
    throw ConfigError(fmt::format("--only {}: matches none of the {} runs; the first is {}", only,
                                  experiment.run_ids.size(), experiment.run_ids.front()));
  return runs;
}

void AddOnlyOption(CLI::App& command, std::string& only) {
  command.add_option("--only", only, "only runs whose id matches this pattern (* ? [abc])");
}

void AddExperimentArgument(CLI::App& command, fs::path& experiment, fs::path& output) {
  command.add_option("EXPERIMENT", experiment, "experiment file, or the folder of its output")
      ->required();
  command.add_option("-o,--output", output,
                     "the folder of an experiment file's output; without it out/NAME");
}

}  // namespace vitruvia
