// `vitruvia learn database | shape | weights | compare | joints | pose-regression`.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddLearnCommand(CLI::App& app);

}  // namespace vitruvia
