// Line 11 of algorithm 1: the pose after the increment that the linear solver found.
#pragma once

#include <Eigen/Core>

#include "methods/realtime_scape/body_pose.h"
#include "methods/realtime_scape/settings.h"

namespace vitruvia::realtime_scape {

struct PoseStep {
  BodyPose pose;
  double largest_rotation_rad = 0.0, largest_translation_m = 0.0;  // of any bone
};

// `increment` has six entries for each bone: a rotation vector (camera frame, radians) about the
// bone's centre and a translation in units of length_unit_m.
PoseStep ApplyIncrement(const BodyPose& pose, const Eigen::VectorXd& increment,
                        double length_unit_m, RotationUpdate update);

// The rotation after an increment (rotation vector in the camera frame, radians).
Matrix3<double> ApplyRotationIncrement(const Matrix3<double>& rotation,
                                       const Vector3<double>& increment, RotationUpdate update);

// Whether a bone's matrix is farther from any rotation than a linear update can move it in one
// frame, or a bone has left the range of any depth camera.
bool HasDiverged(const BodyPose& pose);

}  // namespace vitruvia::realtime_scape
