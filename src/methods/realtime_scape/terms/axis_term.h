// Term 4, main-axis orientation invariance (paper A, eq. 7).
#pragma once

#include "methods/realtime_scape/model.h"
#include "solver/block_normal_equations.h"

namespace vitruvia::realtime_scape {

// Adds α₃ Σ ‖R_j d_j − R_parent(j) d_j‖² over seven bones.
//
// Reading: d_j is the joint's hinge axis in the rest pose. A turn about it leaves R_j d_j =
// R_parent d_j and is free; a twist along the limb, the candy wrapper, is penalised.
void AddAxisTerm(const BodyPose& pose, double weight, BlockNormalEquations& equations);

}  // namespace vitruvia::realtime_scape
