// `vitruvia run`: runs an experiment, or prints its plan (--dry-run).
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

// Upper limit of the number of concurrent runs.
inline constexpr int kMostJobs = 1024;

void AddRunCommand(CLI::App& app);

}  // namespace vitruvia
