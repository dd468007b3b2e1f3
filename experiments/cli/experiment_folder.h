// The folder of an experiment's output, for commands that are given the experiment's file or that
// folder.
#pragma once

#include <filesystem>

namespace CLI {
class App;
}

namespace vitruvia {

// `experiment`: the folder itself, or an experiment file, whose output is in `output` or, if that
// is "", in out/NAME. ConfigError if there is neither, or nothing was run yet.
std::filesystem::path ExperimentFolder(const std::filesystem::path& experiment,
                                       const std::filesystem::path& output);

// The argument EXPERIMENT and the option -o.
void AddExperimentArgument(CLI::App& command, std::filesystem::path& experiment,
                           std::filesystem::path& output);

}  // namespace vitruvia
