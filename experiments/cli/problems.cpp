#include "experiments/cli/problems.h"

#include "core/message.h"

namespace vitruvia {

void PrintProblems(const ReportedExperiment& experiment) {
  for (const ReportedRun& run : experiment.runs) {
    if (!run.problem.empty()) PrintMessage("{}: left out: {}\n", run.run_id, run.problem);
  }
}

}  // namespace vitruvia
