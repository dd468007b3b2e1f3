// A weak prior on the pose, which paper A does not have.
#pragma once

#include "methods/realtime_scape/body_pose.h"
#include "solver/block_normal_equations.h"

namespace vitruvia::realtime_scape {

// Adds weight · Σ_j Σ_k (δ_jk / σ_jk)², where δ_j is the rotation vector from the mean local
// rotation of captured motion to the bone's (body/pose_statistics.h).
void AddPriorTerm(const BodyPose& pose, double weight, BlockNormalEquations& equations);

}  // namespace vitruvia::realtime_scape
