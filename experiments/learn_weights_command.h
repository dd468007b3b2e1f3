// `vitruvia learn weights MESHES [--rest MESH] (--rig DIR | --labels FILE | --bones N) -o DIR`.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

// Below `learn`.
void AddLearnWeightsCommand(CLI::App& learn);

}  // namespace vitruvia
