// `vitruvia scan CONFIG -o DIR`.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddScanCommand(CLI::App& app);

}  // namespace vitruvia
