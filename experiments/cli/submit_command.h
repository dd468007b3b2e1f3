// `vitruvia submit`: the runs of an experiment as a job array of a Slurm cluster.
#pragma once

namespace CLI {
class App;
}

namespace vitruvia {

void AddSubmitCommand(CLI::App& app);

}  // namespace vitruvia
