// `vitruvia import`: recordings of others made into sequences.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddImportCommand(CLI::App& app);

}  // namespace vitruvia
