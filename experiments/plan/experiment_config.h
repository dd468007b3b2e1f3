// An experiment file and the runs that it stands for.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "config/json_settings.h"
#include "experiments/plan/sweep.h"
#include "methods/registry.h"
#include "records/run_record.h"
#include "scoring/score.h"
#include "subjects/fitted_subject.h"
#include "synth/scene/scene.h"
#include "tracking/input_faults.h"

namespace vitruvia {

// Named overrides (RFC 7386 merge patches) of the scene file and of the method file.
struct VariantSettings {
  std::string name;
  std::string description;
  Json scene = Json::object();
  Json method = Json::object();
  // A recipe (fitted_subject.h) or the folder of a body (body_model.h); "": the scene's own
  // template, or what a stored sequence has.
  std::filesystem::path subject;
  InputFaultSettings faults;  // none by default

  void Describe(Fields& fields);
  std::string Problem() const;
};

struct ExpectationSettings {
  std::string metric;
  double paper = std::numeric_limits<double>::quiet_NaN();
  double at_most = std::numeric_limits<double>::quiet_NaN();
  double at_least = std::numeric_limits<double>::quiet_NaN();
  std::string source, remark, not_comparable;
  std::vector<std::string> scenes;  // none: all

  void Describe(Fields& fields);
  std::string Problem() const;
  Expectation AsRecorded() const;
};

struct ExperimentSettings {
  std::string kind = "tracking";
  std::string title, description;
  std::vector<std::filesystem::path> scenes, methods;
  std::vector<std::filesystem::path> sequences;  // stored ones, beside the scenes
  std::vector<VariantSettings> variants;         // none: one without overrides, named "default"
  SweepSettings sweep;
  std::vector<int> seeds{1};
  int repeats = 1;
  bool timed = false;
  std::vector<ExpectationSettings> expectations;
  std::vector<int> picture_frames{0};
  bool side_by_side = false;
  ScoreSettings score;

  void Describe(Fields& fields);
  std::string Problem() const;
};

// One cell of the grid scenes × methods × variants × sweep × seeds × repeats, fully resolved. A
// stored sequence stands for a scene of one seed, the first.
struct RunPlan {
  std::string run_id;   // variant, scene, method, seed, repeat and a hash of the resolved config
  std::string variant;  // its name and the label of the sweep's point
  std::string scene, method_name;
  int seed = 1;
  int repeat = 0;  // 1, 2, … where the experiment has repeats
  int frames = 0;
  std::filesystem::path sequence;  // the folder of a stored one; "": synthesised from the scene
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
  bool timed = false;       // nothing else may run beside its runs
  std::vector<RunPlan> runs;
};

// Reads the experiment and everything it names. Throws ConfigError before anything has run.
ExperimentPlan PlanExperiment(const std::filesystem::path& experiment_file);
// The same of settings that were read from that file, and perhaps changed since.
ExperimentPlan PlanExperiment(const ExperimentSettings& settings,
                              const std::filesystem::path& experiment_file);

// A scene file, with overrides applied.
SceneSettings ReadScene(const std::filesystem::path& scene_file,
                        const Json& overrides = Json::object());

// The file's path below the nearest folder called "configs", without extension; its stem elsewhere.
std::string ConfigName(const std::filesystem::path& file);

}  // namespace vitruvia
