// Shared parts of the plans of all studies.
#pragma once

#include <filesystem>
#include <utility>

#include "experiments/plan/experiment_config.h"
#include "experiments/plan/planned_run.h"

namespace vitruvia {

// The experiment of a file without runs: its name, title, description and, where a study has them,
// expectations.
template <class Settings>
Experiment PlanOf(const Settings& settings, const std::filesystem::path& file) {
  Experiment experiment;
  experiment.record.name = ConfigName(file);
  experiment.record.title = settings.title;
  experiment.record.description = settings.description;
  if constexpr (requires { settings.expectations; }) {
    for (const ExpectationSettings& e : settings.expectations)
      experiment.record.expectations.push_back(e.AsRecorded());
  }
  return experiment;
}

inline void AddRun(PlannedRun run, const WorkFolders& work, Experiment& experiment) {
  run.experiment = experiment.record.name;
  run.work = work;
  experiment.record.run_ids.push_back(run.run_id);
  experiment.runs.push_back(std::move(run));
}

}  // namespace vitruvia
