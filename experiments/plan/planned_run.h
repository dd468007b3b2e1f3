// The plan of an experiment file of any kind: a list of runs that can be executed one by one, in
// any order and by any process.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/build_cache.h"
#include "config/stored_data.h"
#include "records/run_record.h"

namespace vitruvia {

// Folders for results that several runs share.
struct WorkFolders {
  std::filesystem::path sequences;
  std::filesystem::path learned;  // models and fitted subjects
};

// Everything that another process needs to execute the run without the experiment file, which may
// change while the experiment is running. Stored as run.json in the run's folder.
struct PlannedRun {
  static constexpr StoredFormat kFormat{"vitruvia-run", 1, 1, "run the experiment again"};

  std::string experiment;  // its name
  std::string kind;        // of the experiment; selects the function that executes the run
  std::string run_id;
  std::string key;  // CacheKey(resolved)
  // Every setting that the result depends on; files are relative to the folder in which the
  // experiment was planned.
  Json resolved = Json::object();
  std::string variant, scene, method;  // as the run's record names them; "" if it has none
  int seed = 0;
  int repeat = 0;      // 1, 2, … where the same run is carried out several times
  int person = 0;      // number in the population, for experiments about people
  int frames = 0;      // 0: the run has none
  bool timed = false;  // no other run may run on its machine at the same time
  WorkFolders work;
  // Summaries that the experiment defines; the stored estimate does not depend on them.
  std::vector<FrameSummary> summaries;

  std::optional<CachedFolder>
      shares;  // not stored: result that the first of several runs builds for all

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
