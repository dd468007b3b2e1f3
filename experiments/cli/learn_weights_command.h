// `vitruvia learn weights MESHES [--rest MESH] (--rig DIR | --labels FILE | --bones N) -o DIR` and
// `vitruvia learn compare CONFIG [--subjects N] -o FILE`.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

// Below `learn`.
void AddLearnWeightsCommand(CLI::App& learn);
void AddLearnComparisonCommand(CLI::App& learn);

}  // namespace vitruvia
