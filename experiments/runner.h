// Carries out the runs of an experiment: synthesise → track → score → record.
#pragma once

#include <filesystem>

#include "experiments/experiment_config.h"
#include "records/estimate.h"
#include "sequence/sequence.h"

namespace vitruvia {

// Tracks a whole sequence; the clock runs round TrackFrame only. The estimate appears at `folder`
// whole or not at all.
void TrackSequence(const SequenceReader& sequence, const MethodConfig& method,
                   const std::filesystem::path& folder);

// The sequence of a scene below `sequences`, made unless the very same one is there already (same
// settings, same input files, same build).
std::filesystem::path ObtainSequence(const std::string& name, const SceneSettings& scene,
                                     const std::filesystem::path& sequences);

struct ExperimentOutcome {
  int done = 0;    // runs carried out now
  int kept = 0;    // runs found done by this same build
  int failed = 0;  // runs that ended in an error, which the experiment's record names
};

// Runs whatever is not yet done, one run after the other, and writes summary.json and the
// experiment's record (records/run_record.h). A run that fails is recorded and the others go on.
ExperimentOutcome RunExperiment(const ExperimentPlan& plan, const std::filesystem::path& folder,
                                const std::filesystem::path& sequences);

}  // namespace vitruvia
