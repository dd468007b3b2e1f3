// Scores an estimate against its sequence: every metric of a run record, from stored files alone.
#pragma once

#include "config/settings.h"
#include "records/estimate.h"
#include "records/run_record.h"
#include "scoring/bound_score.h"
#include "sequence/sequence.h"

namespace vitruvia {

// A true surface point counts as visible this far behind the z-buffer of the true mesh: about the
// size of a pixel at 3 m, so that slanted surfaces are not called hidden.
inline constexpr double kVisibleWithin_m = 0.01;
// Paper A, section 7.1: a joint within 10 cm counts as found.
inline constexpr double kJointThreshold_m = 0.1;
inline constexpr double kCurveStep_m = 0.005, kCurveLast_m = 0.3;

// When the estimate is compared with the observed depth.
enum class AgainstObservation {
  kWithoutTruth,  // only if the sequence has no true surface
  kAlways,
  kNever,
};

struct ScoreSettings {
  int reconstruction_every = 0;  // frames; 0: not measured
  AgainstObservation against_observation = AgainstObservation::kWithoutTruth;
  BoundSettings bound{};

  void Describe(Fields& fields);
};

// Fills frames, curves, steps, diagonal and the summary's metrics of the record; the caller fills
// in the run's identity (ids, variant, scene, seed, config). Failed frames count in every mean.
// Metrics for which the sequence has no truth are absent, never zero, and the summary's
// "not_scored" names them. DataError if the estimate and the sequence do not belong together.
void ScoreRun(const SequenceReader& sequence, const EstimateReader& estimate,
              const ScoreSettings& settings, RunRecord& record);

}  // namespace vitruvia
