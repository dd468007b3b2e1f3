// What tests and the program fake_runs agree on.
#pragma once

#include <filesystem>
#include <vector>

#include "config/build_cache.h"
#include "experiments/plan/planned_run.h"

namespace vitruvia {

// The file of runs that `fake_runs carry-out` reads.
struct FakeRuns {
  std::vector<PlannedRun> runs;

  void Describe(Fields& f) { f.List("runs", runs, {.meaning = "runs to carry out"}); }
};

// What runs that "share" share.
inline CachedFolder SharedWork(const std::filesystem::path& place) {
  return {place / "shared", "work", {{"of", "all"}}};
}

}  // namespace vitruvia
