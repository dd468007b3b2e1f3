// Where a frame begins, and what its inertia holds on to.
#pragma once

#include "methods/realtime_scape/bone_sight.h"
#include "methods/realtime_scape/model.h"
#include "methods/realtime_scape/settings.h"
#include "methods/realtime_scape/terms/inertia_term.h"

namespace vitruvia::realtime_scape {

struct Prediction {
  BodyPose pose;
  LocalRotations local_rotations;
};

// Constant rotation (paper A, algorithm 1, line 1): the last frame's pose. Constant velocity: every
// joint turns on, and the pelvis moves on, as it did between the last two frames, times
// velocity_share and, for each frame that a bone has not been seen, once more hidden_decay. Limbs
// stay as far from their joints as they were.
Prediction PredictPose(const Model& model, const BodyPose& last, const BodyPose& before_last,
                       const BoneSight& sight, const MotionSettings& settings);

}  // namespace vitruvia::realtime_scape
