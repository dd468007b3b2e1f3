// Front or back: finds out that a body is tracked with its front where its back is.
#pragma once

#include <optional>

#include "methods/realtime_scape/pose_fitter.h"
#include "tracking/search_pause.h"

namespace vitruvia::realtime_scape {

// The pose with the same joints in which front and back, and left and right, are exchanged: each
// bone takes the place of its mirror image and is turned by 180° about the rest pose's vertical.
BodyPose FacingAway(const Model& model, const BodyPose& pose);

// Compares the pose with those of the other facing when model and frame are farther apart in depth
// than usual. A body seen from behind has nearly the outline that it has from the front, so that
// neither classes of vertices nor areas tell one from the other.
class FacingCheck {
 public:
  // `model` must outlive the check, which has its own fitter and clock.
  FacingCheck(const Model& model, const PinholeCamera& camera, const Settings& settings);

  // To be called once for each frame with measurements. `rendered` is the model's depth in the last
  // iteration of `current`, `last` the pose of the last frame. Returns the refined pose of the
  // other facing if it is closer to the frame.
  std::optional<FitSummary> Search(const Observation& observation, const FitSummary& current,
                                   const DepthImage& rendered, const BodyPose& last);

 private:
  bool IsDue(double gap_m2);
  double GapTo(const Observation& observation, const DepthImage& rendered) const;  // m²

  const Model& model_;
  Settings settings_;
  PoseFitter fitter_;
  double usual_m2_ = -1.0;  // gap; negative before the first frame
  SearchPause pause_;
};

}  // namespace vitruvia::realtime_scape
