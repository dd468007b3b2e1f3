// The files of an experiment's folder that describe all of its runs: plan.json, experiment.json and
// summary.json.
#pragma once

#include <filesystem>

#include "core/file_lock.h"
#include "experiments/plan/planned_run.h"

namespace vitruvia {

// Must be held while these files are written.
FileLock LockExperiment(const std::filesystem::path& folder);

// ConfigError if the folder holds the output of another experiment file, which must not be replaced
// (for example of another file with the same name). If the other file no longer exists, it is
// assumed to have been renamed to this one.
void RequireOwnFolder(const std::filesystem::path& folder,
                      const std::filesystem::path& experiment_file);

// Writes experiment.json and plan.json, from which status and report read the whole grid.
void WritePlan(const Experiment& experiment, const std::filesystem::path& experiment_file,
               const std::filesystem::path& folder);

// Rewrites experiment.json and summary.json from the runs' folders; all callers write the same
// content. Returns the number of runs of the grid that are neither done nor failed.
int WriteSummary(const std::filesystem::path& folder);

}  // namespace vitruvia
