// States of a body in anatomical angles before a camera.
#pragma once

#include "core/random.h"
#include "fitting/shaped_body.h"
#include "math/angles.h"
#include "math/rotation.h"

namespace vitruvia {

// Facing the camera from 2.8 m, in the rest pose.
inline BodyState FacingState() {
  BodyState state;
  state.rotation = Vector3d(1.0, -1.0, -1.0).asDiagonal();
  state.pelvis_position = {0.05, 0.0, 2.8};
  AnatomicalPose pose;
  for (auto& side : pose.sides_deg) side[kShoulderAbduction] = 90.0;
  state.angles_deg = AnglesOf(pose);
  return state;
}

// Turned and bent away from there by random angles up to range_deg, within the limits.
inline BodyState RandomState(double range_deg, std::uint64_t seed) {
  RandomStream random(seed, "state");
  const auto some = [&](double range) { return random.Uniform(-range, range); };
  BodyState state = FacingState();
  const double range = range_deg * kRadiansPerDegree;
  state.rotation = ExpSo3<double>(Vector3d(some(range), some(range), some(range))) * state.rotation;
  for (double& angle : state.angles_deg) angle += some(range_deg);
  state.angles_deg =
      state.angles_deg.cwiseMax(JointLimits().min_deg).cwiseMin(JointLimits().max_deg);
  return state;
}

}  // namespace vitruvia
