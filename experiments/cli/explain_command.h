// `vitruvia explain`: what settings and metrics mean.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddExplainCommand(CLI::App& app);

}  // namespace vitruvia
