// Soft joint limits, which paper A does not have.
#pragma once

#include "methods/realtime_scape/body_pose.h"
#include "solver/block_normal_equations.h"

namespace vitruvia::realtime_scape {

// Adds weight · Σ excess², the angle in radians by which each limited axis of each joint is beyond
// its range (body/bone_limits.h), widened by slack_rad at both ends.
void AddLimitTerm(const BodyPose& pose, double slack_rad, double weight,
                  BlockNormalEquations& equations);

}  // namespace vitruvia::realtime_scape
