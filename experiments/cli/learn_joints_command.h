// `vitruvia learn joints`, `vitruvia stand-in-joints`.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddLearnJointsCommand(CLI::App& learn);
void AddStandInJointsCommand(CLI::App& app);

}  // namespace vitruvia
