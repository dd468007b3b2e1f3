// vitruvia view: runs in three dimensions, as a page.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddViewCommand(CLI::App& app);

}  // namespace vitruvia
