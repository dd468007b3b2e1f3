// `vitruvia reproduce`: the papers' figures and tables made anew, on one page.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddReproduceCommand(CLI::App& app);

}  // namespace vitruvia
