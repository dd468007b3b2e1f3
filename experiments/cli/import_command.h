// `vitruvia import`: converts recordings from other sources to sequences.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddImportCommand(CLI::App& app);

}  // namespace vitruvia
