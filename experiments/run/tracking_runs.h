// The runs of a tracking experiment: synthesise → track → score → record.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "experiments/plan/experiment_config.h"
#include "experiments/plan/planned_run.h"
#include "records/estimate.h"
#include "sequence/sequence.h"

namespace vitruvia {

// Tracks a whole sequence with that subject; the clock runs round TrackFrame only. Every frame goes
// through `prepare` before the tracker gets it. The estimate appears at `folder` whole or not at
// all.
void TrackSequence(const SequenceReader& sequence, const MethodConfig& method,
                   const BodyModel& subject, const std::function<void(DepthFrame&)>& prepare,
                   const std::filesystem::path& folder);

// The runs speak of the plan: it must live as long as they do.
std::vector<PlannedRun> TrackingRuns(const ExperimentPlan& plan,
                                     const std::filesystem::path& folder, const WorkFolders& work);

}  // namespace vitruvia
