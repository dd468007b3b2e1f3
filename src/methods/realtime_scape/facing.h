// Compares a pose with those of the other facing (tracking/facing.h).
#pragma once

#include <optional>

#include "methods/realtime_scape/pose_fitter.h"
#include "tracking/facing.h"

namespace vitruvia::realtime_scape {

// Compares the pose with those of the other facing when model and frame are farther apart in depth
// than usual.
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
  double GapTo(const Observation& observation, const DepthImage& rendered) const;  // m²

  const Model& model_;
  Settings settings_;
  PoseFitter fitter_;
  FacingWatch watch_;
};

}  // namespace vitruvia::realtime_scape
