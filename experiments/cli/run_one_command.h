// `vitruvia run-one`: what `vitruvia run` starts for each run.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddRunOneCommand(CLI::App& app);

}  // namespace vitruvia
