// `vitruvia status`: how far the runs of an experiment are.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddStatusCommand(CLI::App& app);

}  // namespace vitruvia
