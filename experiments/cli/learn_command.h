// `vitruvia learn database | shape | weights | compare`.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddLearnCommand(CLI::App& app);

}  // namespace vitruvia
