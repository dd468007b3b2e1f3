// Term 3, inertia of local rotation (paper A, eq. 7).
#pragma once

#include "methods/realtime_scape/model.h"
#include "solver/block_normal_equations.h"

namespace vitruvia::realtime_scape {

using LocalRotations = std::array<Matrix3<double>, kBoneCount>;  // parent_from_bone

// R_parentᵀ R of every bone; the root's parent is the fixed identity.
LocalRotations LocalRotationsOf(const BodyPose& pose);

// Adds α₂ Σ_j ‖R_j − R_parent(j) R_local(j)^{t−1}‖²_F and returns the energy added.
//
// Departure: the paper goes down the tree with the parent's rotation already known; here parent and
// child are unknowns of the same linear system, as eq. 7 is written.
double AddInertiaTerm(const BodyPose& pose, const LocalRotations& previous, double weight,
                      BlockNormalEquations& equations);

}  // namespace vitruvia::realtime_scape
