// Attributes a run's errors to causes: each joint's error in each frame is assigned to one cause,
// determined from the stored data of the sequence and of the run.
//
// A diagnosis names the circumstance under which an error arose. It does not say whether another
// tracker would have avoided the error.
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

// Consecutive frames in which the error is large.
struct ErrorEvent {
  int first = 0, last = 0, worst = 0;  // frames
  Cause cause = Cause::kUnknown;       // the cause of most of the event's error
  double share = 0.0;                  // of the run's error
  std::string reason{};                // "left wrist and 2 more: up to 0.31 m; hidden"
};

struct Diagnosis {
  // Each cause's share of the sum of all joint errors over all frames; the shares sum to 1.
  std::array<double, kCauseCount> shares{};
  std::vector<ErrorEvent> events;  // by descending share, at most kMostEvents
  std::vector<int> lost_frames;    // in which the tracker failed or most joints are far off

  // The cause with the largest share other than kSmall; kSmall if all errors are small.
  Cause Main() const;
};
inline constexpr std::size_t kMostEvents = 10;

// The diagnosis of a sequence without true joints holds only the lost frames that the tracker
// reported.
Diagnosis Diagnose(const SequenceReader& sequence, const EstimateReader& estimate);
// The same from evidence gathered before, which several runs of a sequence can share. `evidence`:
// the result of GatherEvidence, empty if the sequence has no true joints.
Diagnosis Diagnose(const std::vector<FrameEvidence>& evidence, const EstimateReader& estimate);

}  // namespace vitruvia
