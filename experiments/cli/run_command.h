// `vitruvia run`: carries out an experiment, or says what that would mean (--dry-run).
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

// Runs at a time that can be asked for.
inline constexpr int kMostJobs = 1024;

void AddRunCommand(CLI::App& app);

}  // namespace vitruvia
