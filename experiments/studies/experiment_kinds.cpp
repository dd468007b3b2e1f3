#include "experiments/studies/experiment_kinds.h"

#include "core/error.h"
#include "experiments/plan/run_plan.h"
#include "experiments/run/tracking_run.h"
#include "experiments/studies/model_study.h"
#include "experiments/studies/shape_study.h"
#include "experiments/studies/weight_study.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

Experiment PlanTracking(const fs::path& file, const WorkFolders& work) {
  const ExperimentPlan plan = PlanExperiment(file);
  return {plan.record, plan.failed_frames_limit, PlannedRuns(plan, work)};
}

struct Kind {
  const char* name;
  Experiment (*plan)(const fs::path& file, const WorkFolders& work);
  RunRecord (*carry_out)(const PlannedRun& run, const fs::path& run_folder);
};

const std::vector<Kind>& Kinds() {
  static const std::vector<Kind> kinds = {{kTrackingKind, PlanTracking, CarryOutTracking},
                                          {kShapeKind, PlanShapeStudy, CarryOutShapeRun},
                                          {kWeightKind, PlanWeightStudy, CarryOutWeightRun},
                                          {kModelKind, PlanModelStudy, CarryOutModelRun}};
  return kinds;
}

const Kind& FindKind(const std::string& name, const std::string& where) {
  std::vector<std::string> names;
  for (const Kind& known : Kinds()) {
    if (known.name == name) return known;
    names.emplace_back(known.name);
  }
  throw ConfigError(fmt::format("{}: kind: unknown kind of experiment \"{}\"; expected one of {}",
                                where, name, fmt::join(names, ", ")));
}

void RequireSameInputs(const PlannedRun& run) {
  if (CacheKey(run.resolved) == run.key) return;
  throw DataError(
      "a file that the run reads, or the program itself, has changed since the experiment was "
      "planned; run the experiment again");
}

}  // namespace

Experiment PlanAnyExperiment(const fs::path& experiment_file, const WorkFolders& work) {
  const Json json = ReadJsonFile(experiment_file);
  const bool names_kind = json.is_object() && json.contains("kind") && json["kind"].is_string();
  const std::string kind = names_kind ? json["kind"].get<std::string>() : kTrackingKind;
  return FindKind(kind, experiment_file.string()).plan(experiment_file, work);
}

RunRecord CarryOutAnyRun(const PlannedRun& run, const fs::path& run_folder) {
  RequireSameInputs(run);
  return FindKind(run.kind, run.run_id).carry_out(run, run_folder);
}

}  // namespace vitruvia
