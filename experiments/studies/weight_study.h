// Experiments of the kind "skinning_weights" (paper A, figure 3): weights learnt from one person's
// examples explain the examples of people that were not learnt from.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/plan/experiment_config.h"
#include "experiments/plan/planned_run.h"
#include "subjects/learned_model.h"

namespace vitruvia {

struct WeightStudySettings {
  std::string kind, title, description;
  std::filesystem::path learning;
  int people = 3;         // the first of the held-out ones
  int picture_poses = 3;  // how many of each one's poses are drawn
  std::vector<ExpectationSettings> expectations;

  void Describe(Fields& fields);
};

// One run for each person: the learnt weights are kept, bones' transforms are fitted to every pose.
// Pictures: the pose, the linearly skinned body, both, the bones, and the error.
Experiment PlanWeightStudy(const std::filesystem::path& file, const WorkFolders& work);

}  // namespace vitruvia
