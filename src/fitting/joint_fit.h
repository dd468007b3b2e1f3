// A body's pose from approximately known joint positions.
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

// The state whose joints best match the known ones (at least one): least squares within the joint
// limits, with a prior on the angles about `start`. The body stays upright; its heading about the y
// axis is free.
BodyState FittedToJoints(const ShapedBody& body, const BodyState& start, const KnownJoints& known,
                         double angle_deviation_deg);

}  // namespace vitruvia
