// `vitruvia reproduce`: reproduces the papers' figures and tables on one page.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddReproduceCommand(CLI::App& app);

}  // namespace vitruvia
