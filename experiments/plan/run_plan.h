// The runs of a tracking experiment.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/plan/experiment_config.h"
#include "experiments/plan/planned_run.h"
#include "methods/registry.h"
#include "subjects/fitted_subject.h"
#include "synth/scene/scene.h"

namespace vitruvia {

// One cell of the grid scenes × methods × variants × sweep × seeds × repeats, with all settings
// resolved. A stored sequence replaces a scene and is run only with the first seed.
struct RunPlan {
  std::string run_id;   // variant, scene, method, seed, repeat and a hash of the resolved config
  std::string variant;  // the variant's name and the label of the sweep's point
  std::string scene, method_name;
  int seed = 1;
  int repeat = 0;  // 1, 2, … where the experiment has repeats
  int frames = 0;
  std::filesystem::path sequence;  // folder of a stored one; "": synthesised from the scene
  SceneSettings scene_settings;
  MethodConfig method;
  std::optional<SubjectRecipe> subject;
  std::filesystem::path subject_folder;
  InputFaultSettings faults;
  ScoreSettings score;
  // { "scene" or "sequence", "method", "score", and as the variant says "subject" or
  // "subject_folder", "faults" }
  Json resolved;
};

struct ExperimentPlan {
  ExperimentRecord record;  // without failures
  bool timed = false;       // its runs must be the only ones on their machine
  double failed_frames_limit = kFailedFramesLimit;
  std::vector<RunPlan> runs;
};

// Reads the experiment and everything it names. Throws ConfigError before anything has run.
ExperimentPlan PlanExperiment(const std::filesystem::path& experiment_file);
// The same for settings that were read from that file and may have been changed.
ExperimentPlan PlanExperiment(const ExperimentSettings& settings,
                              const std::filesystem::path& experiment_file);

// The runs in the form that is stored for the processes that carry them out.
std::vector<PlannedRun> PlannedRuns(const ExperimentPlan& plan, const WorkFolders& work);
// The inverse of PlannedRuns for one run.
RunPlan ReadRunPlan(const PlannedRun& planned);
// Only what the subject depends on: the method may have had other settings when the run was made.
RunPlan ReadSubjectPlan(const PlannedRun& planned);

// The sequence of the run's scene, made at most once below `cache`.
CachedFolder SequenceOf(const RunPlan& run, const std::filesystem::path& cache);

// A scene file, with overrides applied.
SceneSettings ReadScene(const std::filesystem::path& scene_file,
                        const Json& overrides = Json::object());

}  // namespace vitruvia
