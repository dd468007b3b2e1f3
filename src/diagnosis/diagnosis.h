// Why a run's estimate is wrong where it is wrong: each joint's error of each frame is given to one
// cause, decided from what is stored of the sequence and of the run.
//
// A diagnosis names the circumstance under which an error arose. Whether another tracker would have
// coped is not its question.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "diagnosis/cause.h"
#include "diagnosis/joint_evidence.h"
#include "records/estimate.h"
#include "records/run_record.h"
#include "sequence/sequence.h"

namespace vitruvia {

// Frames that belong together because the error is large in them.
struct ErrorEvent {
  int first = 0, last = 0, worst = 0;  // frames
  Cause cause = Cause::kUnknown;       // that holds most of the event's error
  double share = 0.0;                  // of the run's error
  std::string reason{};                // "left wrist and 2 more: up to 0.31 m; hidden"
};

struct Diagnosis {
  // Share of the sum of all joint errors over all frames that each cause holds; sums to 1.
  std::array<double, kCauseCount> shares{};
  std::vector<ErrorEvent> events;  // the largest share first, at most kMostEvents
  std::vector<int> lost_frames;    // in which the tracker failed or most joints are far off

  // The cause of the largest share, small errors aside; kSmall where all errors are small.
  Cause Main() const;
};
inline constexpr std::size_t kMostEvents = 10;

// Nothing is known of a sequence without true joints: its diagnosis has lost frames only, those
// that the tracker reported.
Diagnosis Diagnose(const SequenceReader& sequence, const EstimateReader& estimate);
// The same from what was gathered of the sequence before, for several runs of it. `evidence`: of
// GatherEvidence, empty where the sequence has no true joints.
Diagnosis Diagnose(const std::vector<FrameEvidence>& evidence, const EstimateReader& estimate);

}  // namespace vitruvia
