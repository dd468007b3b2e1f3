// `vitruvia learn pose-regression`.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddLearnRegressionCommand(CLI::App& learn);

}  // namespace vitruvia
