// The kinds of experiments that `vitruvia run` carries out: an experiment file's "kind" decides.
#pragma once

#include <filesystem>

#include "experiments/plan/planned_run.h"

namespace vitruvia {

// "tracking" (the default; experiment_config.h), "intrinsic_shape" (shape_study.h),
// "skinning_weights" (weight_study.h) or "model_drawing" (model_study.h). Throws ConfigError before
// anything has run.
Experiment PlanAnyExperiment(const std::filesystem::path& experiment_file, const WorkFolders& work);

// Carries out a run of an experiment of any kind, in the run's own process (run_process.h).
// DataError if what the run depends on has changed since it was planned.
RunRecord CarryOutAnyRun(const PlannedRun& run, const std::filesystem::path& run_folder);

}  // namespace vitruvia
