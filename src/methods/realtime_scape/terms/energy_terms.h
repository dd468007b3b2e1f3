// The whole energy (paper A, eq. 7): the rows of all terms.
#pragma once

#include <vector>

#include "methods/realtime_scape/model.h"
#include "methods/realtime_scape/settings.h"
#include "methods/realtime_scape/terms/energy_term.h"
#include "solver/block_normal_equations.h"
#include "tracking/classification.h"

namespace vitruvia::realtime_scape {

class JointTerm;
struct FreeSpace;

// All that a term may depend on, at one linearisation.
struct TermInput {
  const Model& model;
  const PinholeCamera& camera;
  const Settings& settings;
  const JointTerm& joints;
  const BodyPose& pose;
  const LocalRotations& expected;  // reference rotations of the inertia term
  const VertexClasses& classes;
  const std::vector<Pair>& pairs;
  const FreeSpace& free_space;
};

// Adds the rows of all terms to the normal equations. The unknowns of each bone are a rotation
// exp(r), applied on the left about the bone's centre, and a translation of the centre in units of
// settings.length_unit_m.
Energies AddEnergyTerms(const TermInput& input, BlockNormalEquations& equations);

}  // namespace vitruvia::realtime_scape
