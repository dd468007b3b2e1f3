#include "experiments/studies/experiment_kinds.h"

#include <functional>
#include <memory>

#include "core/error.h"
#include "experiments/run/tracking_runs.h"
#include "experiments/studies/shape_study.h"
#include "experiments/studies/weight_study.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

Experiment PlanTracking(const fs::path& file, const fs::path& folder, const WorkFolders& work) {
  // The runs speak of the plan as long as they live.
  const auto plan = std::make_shared<ExperimentPlan>(PlanExperiment(file));
  Experiment experiment{plan->record, TrackingRuns(*plan, folder, work)};
  for (PlannedRun& run : experiment.runs) {
    run.carry_out = [plan, carry_out = std::move(run.carry_out)](const fs::path& run_folder) {
      return carry_out(run_folder);
    };
  }
  return experiment;
}

struct Kind {
  const char* name;
  std::function<Experiment(const fs::path&, const fs::path&, const WorkFolders&)> plan;
};

const std::vector<Kind>& Kinds() {
  static const std::vector<Kind> kinds = {
      {"tracking", PlanTracking},
      {"intrinsic_shape", [](const fs::path& file, const fs::path&,
                             const WorkFolders& work) { return PlanShapeStudy(file, work); }},
      {"skinning_weights", [](const fs::path& file, const fs::path&, const WorkFolders& work) {
         return PlanWeightStudy(file, work);
       }}};
  return kinds;
}

}  // namespace

Experiment PlanAnyExperiment(const fs::path& experiment_file, const fs::path& folder,
                             const WorkFolders& work) {
  const Json json = ReadJsonFile(experiment_file);
  std::string kind = Kinds().front().name;
  if (json.is_object() && json.contains("kind") && json["kind"].is_string()) kind = json["kind"];
  std::vector<std::string> names;
  for (const Kind& known : Kinds()) {
    if (known.name == kind) return known.plan(experiment_file, folder, work);
    names.emplace_back(known.name);
  }
  throw ConfigError(fmt::format("{}: kind: unknown kind of experiment \"{}\"; expected one of {}",
                                experiment_file.string(), kind, fmt::join(names, ", ")));
}

}  // namespace vitruvia
