// What Realtime SCAPE derives from poses.
#pragma once

#include <array>

#include "tracking/body_pose.h"

namespace vitruvia::realtime_scape {

using LocalRotations = std::array<Matrix3<double>, kBoneCount>;  // parent_from_bone

// R_parent⁻¹ R of every bone; the root's parent is the fixed identity.
LocalRotations LocalRotationsOf(const BodyPose& pose);

// Mean angle between the local rotations of two poses, radians.
double MeanJointAngle(const BodyPose& a, const BodyPose& b);

// The whole body moved by `shift` (camera frame, metres).
BodyPose Translated(BodyPose pose, const Vector3d& shift);

// The whole body rotated about its root's centre.
BodyPose RotatedAboutRoot(BodyPose pose, const Matrix3<double>& rotation);

}  // namespace vitruvia::realtime_scape
