// `vitruvia synth`: sequences from scenes, and previews of them.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddSynthCommand(CLI::App& app);

}  // namespace vitruvia
