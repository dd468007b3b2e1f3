// Derivatives of the bones' rotations with respect to the joint angles.
#pragma once

#include <vector>

#include "fitting/shaped_body.h"

namespace vitruvia {

// The rotation of one bone relative to its parent per radian of one angle.
struct AngleTurn {
  int angle, bone;
  Vector3d axis;  // angular velocity, parent's frame
};

JointPose LocalRotations(const AngleVector& angles_deg);

// In ascending order of angles, then of bones. By central differences, exact to 1e-8.
std::vector<AngleTurn> AngleTurns(const AngleVector& angles_deg);

}  // namespace vitruvia
