// A pull of every joint towards the T-pose. Ours: paper A has none.
#pragma once

#include "methods/realtime_scape/body_pose.h"
#include "solver/block_normal_equations.h"

namespace vitruvia::realtime_scape {

// Adds weight · Σ_j |δ_j|², δ_j the rotation vector of bone j's rotation against its parent's.
void AddRestTerm(const BodyPose& pose, double weight, BlockNormalEquations& equations);

}  // namespace vitruvia::realtime_scape
