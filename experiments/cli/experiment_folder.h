// The folder of an experiment's output, for commands that are given the experiment's file or that
// folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "records/run_record.h"

namespace CLI {
class App;
}

namespace vitruvia {

// `experiment`: the folder itself, or an experiment file, whose output is in `output` or, if that
// is "", in out/NAME. ConfigError if there is neither, nothing was run yet, or the folder is that
// of another experiment file.
std::filesystem::path ExperimentFolder(const std::filesystem::path& experiment,
                                       const std::filesystem::path& output);

// The ids of the experiment's runs that match the pattern `only`, all if it is "". ConfigError if
// none does.
std::vector<std::string> RunsMatching(const ExperimentRecord& experiment, const std::string& only);

// The option --only of such a pattern.
void AddOnlyOption(CLI::App& command, std::string& only);

// The argument EXPERIMENT and the option -o.
void AddExperimentArgument(CLI::App& command, std::filesystem::path& experiment,
                           std::filesystem::path& output);

}  // namespace vitruvia
