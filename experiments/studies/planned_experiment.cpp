#include "experiments/studies/planned_experiment.h"

#include "experiments/plan/experiment_config.h"
#include "experiments/studies/experiment_kinds.h"

namespace vitruvia {
namespace fs = std::filesystem;

PlannedExperiment PlanForOutput(const fs::path& experiment_file, const fs::path& output) {
  const fs::path root = output.empty() ? fs::path("out") : output;
  const fs::path folder = output.empty() ? root / ConfigName(experiment_file) : output;
  return {PlanAnyExperiment(experiment_file, folder, {root / "sequences", root / "learned"}),
          folder, root};
}

}  // namespace vitruvia
