// `vitruvia sufficient`.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddSufficientCommand(CLI::App& app);

}  // namespace vitruvia
