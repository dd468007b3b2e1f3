// Experiments of the kind "skinning_weights" (paper A, figure 3): tests weights learnt from one
// person's examples on the examples of held-out people.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/plan/experiment_config.h"
#include "experiments/plan/planned_run.h"
#include "subjects/learned_model.h"

namespace vitruvia {

inline constexpr const char* kWeightKind = "skinning_weights";

struct WeightStudySettings {
  std::string kind, title, description;
  std::filesystem::path learning;
  int people = 3;         // the first people of the held-out ones
  int picture_poses = 3;  // drawn for each person
  std::vector<ExpectationSettings> expectations;

  void Describe(Fields& fields);
};

// One run for each person. Throws ConfigError before anything has run.
Experiment PlanWeightStudy(const std::filesystem::path& file, const WorkFolders& work);
// Fits the bones' transforms to every pose with the learnt weights. Pictures: the pose, the
// linearly skinned body, the bones, and the error.
RunRecord CarryOutWeightRun(const PlannedRun& run, const std::filesystem::path& run_folder);

}  // namespace vitruvia
