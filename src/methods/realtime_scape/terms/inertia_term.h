// Term 3, inertia of local rotation (paper A, eq. 7).
#pragma once

#include "methods/realtime_scape/body_pose.h"
#include "solver/block_normal_equations.h"

namespace vitruvia::realtime_scape {

// Adds α₂ Σ_j ‖R_j − R_parent(j) R_local(j)^{t−1}‖²_F.
//
// Departure: the paper traverses the tree with the parent's rotation already known; here parent and
// child are both unknowns of the linear system, as in eq. 7.
void AddInertiaTerm(const BodyPose& pose, const LocalRotations& previous, double weight,
                    BlockNormalEquations& equations);

}  // namespace vitruvia::realtime_scape
