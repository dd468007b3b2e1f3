// How the bones turn when a joint angle changes.
#pragma once

#include <vector>

#include "fitting/shaped_body.h"

namespace vitruvia {

// A turn of one bone against its parent that an angle makes, per radian of the angle.
struct AngleTurn {
  int angle, bone;
  Vector3d axis;  // angular velocity, parent's frame
};

JointPose LocalRotations(const AngleVector& angles_deg);

// In ascending order of angles, then of bones. By central differences, exact to 1e-8.
std::vector<AngleTurn> AngleTurns(const AngleVector& angles_deg);

}  // namespace vitruvia
