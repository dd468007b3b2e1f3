// A body's pose from joints whose places are known roughly.
#pragma once

#include <vector>

#include "fitting/shaped_body.h"

namespace vitruvia {

struct KnownJoint {
  int joint = -1;                        // index of its bone
  Vector3d position = Vector3d::Zero();  // world frame, metres
};

struct KnownJoints {
  std::vector<KnownJoint> joints;
  double deviation_m = 0.02;  // standard deviation of a coordinate
};

// The state, near `start` in its angles and upright in any direction about the y axis, whose joints
// are nearest to the known ones (at least one): least squares with a prior on the angles, within
// joint limits.
BodyState FittedToJoints(const ShapedBody& body, BodyState start, const KnownJoints& known,
                         double angle_deviation_deg);

}  // namespace vitruvia
