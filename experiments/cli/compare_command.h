// `vitruvia compare DIR [DIR] [--reference VARIANT] [--metric KEY …] [-o FILE.json|FILE.csv]`.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddCompareCommand(CLI::App& app);

}  // namespace vitruvia
