// Selects the runs of an experiment that a call executes.
#pragma once

#include <string>
#include <vector>

#include "experiments/plan/planned_run.h"

namespace vitruvia {

struct RunSelection {
  std::string only;   // a pattern (* ? [abc]) of run ids, variants or scenes; "": all
  std::string shard;  // "i/n": every n-th run from the i-th, 1 ≤ i ≤ n; "": all
};

// The selected runs in the grid's order; shards divide the runs that `only` selects. ConfigError if
// the pattern matches nothing or the shard is invalid. A shard can be empty.
std::vector<PlannedRun> SelectedRuns(const std::vector<PlannedRun>& runs,
                                     const RunSelection& selection);

}  // namespace vitruvia
