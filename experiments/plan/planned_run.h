// What an experiment file stands for, whatever its kind: a list of runs that can be carried out one
// by one, in any order and by any process.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/build_cache.h"
#include "config/stored_data.h"
#include "records/run_record.h"

namespace vitruvia {

// Where work is kept that several runs share.
struct WorkFolders {
  std::filesystem::path sequences;
  std::filesystem::path learned;  // models and fitted subjects
};

// All that another process needs to carry out the run, without the experiment file: what the file
// says may change while the experiment goes on. Stored as run.json in the run's folder.
struct PlannedRun {
  static constexpr StoredFormat kFormat{"vitruvia-run", 1, 1, "run the experiment again"};

  std::string experiment;  // its name
  std::string kind;        // of the experiment; says which function carries out the run
  std::string run_id;
  std::string key;  // CacheKey(resolved)
  // Every setting that the result depends on; files are named as seen from the folder in which the
  // experiment was planned.
  Json resolved = Json::object();
  std::string variant, scene, method;  // as the run's record names them; "" if it has none
  int seed = 0;
  int repeat = 0;      // 1, 2, … where the same run is carried out several times
  int person = 0;      // number in the population, for experiments about people
  int frames = 0;      // 0: the run has none
  bool timed = false;  // nothing else may run beside it on its machine
  WorkFolders work;
  // Of the experiment's own; what is stored for tracking does not depend on them.
  std::vector<FrameSummary> summaries;

  std::optional<CachedFolder>
      shares;  // not stored: work that the first of several runs does for all

  void Describe(Fields& fields);
};

// RunError if it cannot be written.
void WritePlannedRun(const std::filesystem::path& run_folder, const PlannedRun& run);
// DataError if it is missing or damaged.
PlannedRun ReadPlannedRun(const std::filesystem::path& run_folder);

// Where settings of `resolved` were read from: their files are named as seen from this folder.
JsonOrigin ResolvedOrigin(const char* key);

struct Experiment {
  ExperimentRecord record;           // without failures
  double failed_frames_limit = 1.0;  // share of a run's frames that may fail
  std::vector<PlannedRun> runs;
};

}  // namespace vitruvia
