// Tracks one subject before one camera by algorithm 1 of paper A.
#pragma once

#include <optional>

#include "methods/realtime_scape/facing.h"
#include "methods/realtime_scape/limb_finder.h"
#include "methods/realtime_scape/relocalizer.h"
#include "tracking/area_watch.h"
#include "tracking/frame_checks.h"
#include "tracking/loss_detector.h"

namespace vitruvia::realtime_scape {

class SubjectTracker {
 public:
  SubjectTracker(const Subject& subject, const PinholeCamera& camera, const Settings& settings);
  SubjectTracker(const SubjectTracker&) = delete;  // its parts refer to its model
  SubjectTracker& operator=(const SubjectTracker&) = delete;

  TrackResult TrackFrame(const DepthFrame& frame);

 private:
  struct Ending {
    Outcome outcome;
    std::string message;
  };

  std::optional<PoseHistory> FirstPose(const Observation& observation, const KnownJoints& known);
  PoseHistory Place(const PointCloud& cloud) const;
  FitSummary TakeBetterPose(const Observation& observation, FitSummary fit, bool is_first);
  FitSummary TakeOtherFacing(const Observation& observation, FitSummary fit);
  FitSummary TakeFoundLimb(const Observation& observation, FitSummary fit);
  TrackResult CarryOver(Ending ending);
  Ending EndingOf(const FitSummary& fit) const;
  TrackResult Result(FitSummary fit, Ending ending) const;

  std::optional<FitSummary> FindElsewhere(const Observation& observation, const FitSummary& fit);
  std::vector<JointSupport> SupportsOf(const Observation& observation, const FitSummary& fit);
  BodyAreas MeasureAreas(const Observation& observation, const FitSummary& fit);

  PinholeCamera camera_;
  Settings settings_;
  Model model_;
  Observer observer_;
  PoseFitter fitter_;
  std::optional<FacingCheck> facing_check_;  // if enabled in the settings
  std::optional<LimbFinder> limb_finder_;    // if enabled in the settings
  Relocalizer relocalizer_;
  LossDetector loss_detector_;
  std::optional<AreaWatch> watch_;           // if enabled in the settings
  std::optional<BodyAreaMeter> area_meter_;  // of the watch and of joint supports
  std::optional<StartSearch> start_search_;
  std::string start_message_;  // of the last search
  StepClock<RealtimeScapeStep> clock_;
  std::optional<PoseHistory> history_;  // from the first frame with measurements on
};

}  // namespace vitruvia::realtime_scape
