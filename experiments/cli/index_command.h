// `vitruvia index DIR`.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddIndexCommand(CLI::App& app);

}  // namespace vitruvia
