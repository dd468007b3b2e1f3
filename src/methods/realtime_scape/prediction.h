// Line 1 of algorithm 1 (paper A): the initial pose of a frame.
#pragma once

#include "methods/realtime_scape/model.h"
#include "methods/realtime_scape/pose_history.h"
#include "methods/realtime_scape/settings.h"

namespace vitruvia::realtime_scape {

struct Prediction {
  BodyPose pose;
  LocalRotations local_rotations;  // reference of the inertia term
};

// Constant rotation (paper A): the last frame's pose. Constant velocity: the local rotation of
// every joint and the translation of the root repeat their change between the last two frames,
// times velocity_share and, for each frame in which the bone was not observed, times hidden_decay.
// The gaps between neighbouring bones do not change.
Prediction PredictPose(const Model& model, const PoseHistory& history,
                       const MotionSettings& settings);

}  // namespace vitruvia::realtime_scape
