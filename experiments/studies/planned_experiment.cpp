#include "experiments/studies/planned_experiment.h"

#include "experiments/plan/experiment_config.h"
#include "experiments/run/experiment_files.h"
#include "experiments/studies/experiment_kinds.h"

namespace vitruvia {
namespace fs = std::filesystem;

namespace {

constexpr const char* kUsualRoot = "out";

}  // namespace

fs::path OutputFolder(const fs::path& experiment_file, const fs::path& output) {
  return output.empty() ? kUsualRoot / fs::path(ConfigName(experiment_file)) : output;
}

PlannedExperiment PlanForOutput(const fs::path& experiment_file, const fs::path& output) {
  const fs::path root = output.empty() ? fs::path(kUsualRoot) : output;
  const fs::path folder = OutputFolder(experiment_file, output);
  PlannedExperiment planned{
      PlanAnyExperiment(experiment_file, {root / "sequences", root / "learned"}), experiment_file,
      folder, root};
  RequireOwnFolder(folder, experiment_file);
  return planned;
}

}  // namespace vitruvia
