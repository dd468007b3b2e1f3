// `vitruvia run`: carries out an experiment, or says what that would mean (--dry-run).
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddRunCommand(CLI::App& app);

}  // namespace vitruvia
