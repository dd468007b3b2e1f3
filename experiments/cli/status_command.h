// `vitruvia status`: prints the progress of an experiment's runs.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddStatusCommand(CLI::App& app);

}  // namespace vitruvia
