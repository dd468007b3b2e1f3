// Realtime SCAPE (paper A, algorithm 1): the pose of 17 bones of a linear blend skinning body by
// linearised least squares.
#pragma once

#include <memory>

#include "methods/realtime_scape/settings.h"
#include "tracking/tracker.h"

namespace vitruvia::realtime_scape {

class SubjectTracker;

class RealtimeScape final : public Tracker {
 public:
  explicit RealtimeScape(const Settings& settings);
  ~RealtimeScape() override;

  // Throws std::invalid_argument if the subject's weights do not match its vertices and the bones.
  void Start(const Subject& subject, const PinholeCamera& camera) override;
  TrackResult TrackFrame(const DepthFrame& frame) override;

 private:
  Settings settings_;
  std::unique_ptr<SubjectTracker> tracker_;
};

}  // namespace vitruvia::realtime_scape
