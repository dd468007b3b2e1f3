// Carries out the runs of an experiment: synthesise → track → score → record.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/experiment_config.h"
#include "records/estimate.h"
#include "sequence/sequence.h"

namespace vitruvia {

// Where work is kept that several runs share.
struct WorkFolders {
  std::filesystem::path sequences;
  std::filesystem::path learned;  // models and fitted subjects
};

// Tracks a whole sequence with that subject; the clock runs round TrackFrame only. The estimate
// appears at `folder` whole or not at all.
void TrackSequence(const SequenceReader& sequence, const MethodConfig& method,
                   const BodyModel& subject, const std::filesystem::path& folder);

// The sequence of a scene below `sequences`, made unless the very same one is there already (same
// settings, same input files, same build).
std::filesystem::path ObtainSequence(const std::string& name, const SceneSettings& scene,
                                     const std::filesystem::path& sequences);

struct ExperimentOutcome {
  int done = 0;    // runs carried out now
  int kept = 0;    // runs found done by this same build
  int failed = 0;  // runs that ended in an error, which the experiment's record names
};

// A run of any kind of experiment.
struct PlannedRun {
  std::string run_id;
  std::string key;  // WorkKey() of all that its result depends on
  // Does the work; writes what it likes into its own folder.
  std::function<RunRecord(const std::filesystem::path& run_folder)> carry_out;
};

// Carries out whatever is not yet done, one run after the other, and writes summary.json and the
// experiment's record (records/run_record.h). A run that fails is recorded and the others go on.
ExperimentOutcome CarryOutRuns(const ExperimentRecord& experiment,
                               const std::vector<PlannedRun>& runs,
                               const std::filesystem::path& folder);

// The runs of a tracking experiment.
std::vector<PlannedRun> TrackingRuns(const ExperimentPlan& plan,
                                     const std::filesystem::path& folder, const WorkFolders& work);

}  // namespace vitruvia
