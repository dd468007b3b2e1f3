// A planned experiment file and the folder of its output.
#pragma once

#include <filesystem>

#include "experiments/plan/planned_run.h"

namespace vitruvia {

struct PlannedExperiment {
  Experiment experiment;
  std::filesystem::path file;    // of the experiment
  std::filesystem::path folder;  // of its output
  std::filesystem::path root;    // folder that may also contain the output of other experiments
};

// Where the output of an experiment file goes: `output`, or out/NAME if that is "".
std::filesystem::path OutputFolder(const std::filesystem::path& experiment_file,
                                   const std::filesystem::path& output);

// The output goes to OutputFolder. Writes nothing. ConfigError also if
// the folder holds the output of another experiment file.
PlannedExperiment PlanForOutput(const std::filesystem::path& experiment_file,
                                const std::filesystem::path& output);

}  // namespace vitruvia
