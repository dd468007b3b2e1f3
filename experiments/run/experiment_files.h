// The files of an experiment's folder that are about all of its runs: plan.json, experiment.json
// and summary.json.
#pragma once

#include <filesystem>

#include "core/file_lock.h"
#include "experiments/plan/planned_run.h"

namespace vitruvia {

// To be held while files about the whole experiment are written.
FileLock LockExperiment(const std::filesystem::path& folder);

// ConfigError if the folder holds the output of another experiment file, which must not be
// replaced: two files of one name, say. A file that is gone is taken for this one under an older
// name.
void RequireOwnFolder(const std::filesystem::path& folder,
                      const std::filesystem::path& experiment_file);

// Writes what status and report need to know of the whole grid: experiment.json and plan.json.
void WritePlan(const Experiment& experiment, const std::filesystem::path& experiment_file,
               const std::filesystem::path& folder);

// Writes experiment.json and summary.json anew from the runs' folders; every caller writes the
// same. Returns how many runs of the grid are neither done nor failed.
int WriteSummary(const std::filesystem::path& folder);

}  // namespace vitruvia
