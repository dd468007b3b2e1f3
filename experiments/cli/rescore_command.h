// `vitruvia rescore`: recomputes all metrics of an experiment from the stored estimates.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddRescoreCommand(CLI::App& app);

}  // namespace vitruvia
