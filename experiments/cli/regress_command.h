// `vitruvia regress CONFIG --baseline DIR [--only TEXT] [--update --reason TEXT] [--stored]`.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddRegressCommand(CLI::App& app);

}  // namespace vitruvia
