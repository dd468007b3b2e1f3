// A run of a tracking experiment: synthesise → track → score → record.
#pragma once

#include <filesystem>
#include <functional>

#include "experiments/plan/planned_run.h"
#include "methods/registry.h"
#include "records/estimate.h"
#include "sequence/sequence.h"

namespace vitruvia {

// Tracks a whole sequence with that subject; only TrackFrame is timed. Every frame goes through
// `prepare` before the tracker gets it. The estimate appears at `folder` whole or not at all.
void TrackSequence(const SequenceReader& sequence, const PinholeCamera& camera,
                   const MethodConfig& method, const BodyModel& subject,
                   const std::function<void(DepthFrame&)>& prepare,
                   const std::filesystem::path& folder);

// The subject that the tracker of a run got: its variant's, else the sequence's. DataError if there
// is none, or it is no longer where the run found it.
BodyModel TrackedSubject(const PlannedRun& planned, const SequenceReader& sequence);

// Carries out the run: estimate and log go to the run's folder, the record is returned. A sequence
// or a fitted subject that other runs need too is made at most once.
RunRecord CarryOutTracking(const PlannedRun& planned, const std::filesystem::path& run_folder);

}  // namespace vitruvia
