#include "methods/realtime_scape/realtime_scape.h"

#include "core/error.h"
#include "methods/realtime_scape/subject_tracker.h"

namespace vitruvia::realtime_scape {

RealtimeScape::RealtimeScape(const Settings& settings) : settings_(settings) {}

RealtimeScape::~RealtimeScape() = default;

void RealtimeScape::Start(const Subject& subject, const PinholeCamera& camera) {
  const std::string problem =
      WeightsProblem(subject.weights, subject.rest.vertices.size(), kBoneCount);
  Require(problem.empty(), "Realtime SCAPE cannot use subject {}: {}", subject.name, problem);
  tracker_ = std::make_unique<SubjectTracker>(subject, camera, settings_);
}

TrackResult RealtimeScape::TrackFrame(const DepthFrame& frame) {
  Require(tracker_ != nullptr, "TrackFrame called before Start");
  return tracker_->TrackFrame(frame);
}

}  // namespace vitruvia::realtime_scape
