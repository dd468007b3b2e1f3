// What an experiment file stands for, whatever its kind: a list of runs that can be carried out one
// by one, in any order and by any process.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/build_cache.h"
#include "records/run_record.h"

namespace vitruvia {

// Where work is kept that several runs share.
struct WorkFolders {
  std::filesystem::path sequences;
  std::filesystem::path learned;  // models and fitted subjects
};

struct PlannedRun {
  std::string run_id;
  std::string key;  // CacheKey() of all that its result depends on
  // Does the work; writes what it likes into its own folder.
  std::function<RunRecord(const std::filesystem::path& run_folder)> carry_out;

  std::string variant, scene, method;  // as its record will say; "" if it has none
  int frames = 0;                      // 0: it has none
  bool timed = false;                  // nothing else may run beside it on its machine
  std::optional<CachedFolder> shares;  // work that the first of several runs does for all
};

struct Experiment {
  ExperimentRecord record;  // without failures
  std::vector<PlannedRun> runs;
};

}  // namespace vitruvia
