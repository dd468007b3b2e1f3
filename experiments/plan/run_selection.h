// Which runs of an experiment one call is about.
#pragma once

#include <string>
#include <vector>

#include "experiments/plan/planned_run.h"

namespace vitruvia {

struct RunSelection {
  std::string only;   // a pattern (* ? [abc]) of run ids, variants or scenes; "": all
  std::string shard;  // "i/n": every n-th run from the i-th, 1 ≤ i ≤ n; "": all
};

// In the grid's order; shards are parts of what `only` leaves. ConfigError if the pattern matches
// nothing or the shard is none. A shard can be empty.
std::vector<PlannedRun> SelectedRuns(const std::vector<PlannedRun>& runs,
                                     const RunSelection& selection);

}  // namespace vitruvia
