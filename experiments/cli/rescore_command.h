// `vitruvia rescore`: every metric of an experiment again, from the stored estimates.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddRescoreCommand(CLI::App& app);

}  // namespace vitruvia
