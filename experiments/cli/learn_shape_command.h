// `vitruvia learn database | shape` and `vitruvia fit`.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

// Below `learn`.
void AddLearnDatabaseCommand(CLI::App& learn);
void AddLearnShapeCommand(CLI::App& learn);
// At the top level.
void AddFitCommand(CLI::App& app);

}  // namespace vitruvia
