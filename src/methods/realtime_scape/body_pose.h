// The pose that Realtime SCAPE estimates.
#pragma once

#include <array>

#include "body/skeleton.h"
#include "geometry/mesh.h"

namespace vitruvia::realtime_scape {

// Each bone's rotation is about its own centre (the weighted mean of its vertices), not about the
// subject's origin on the floor: the energy is the same, but a rotation step of the head does not
// translate it by metres, so the thresholds of the stopping rule are comparable between bones and
// the equations are better conditioned.
struct BonePose {
  Matrix3<double> rotation = Matrix3<double>::Identity();  // camera_from_rest
  Vector3<double> center = Vector3<double>::Zero();        // camera frame, metres
};
using BodyPose = std::array<BonePose, kBoneCount>;

using LocalRotations = std::array<Matrix3<double>, kBoneCount>;  // parent_from_bone

// a⁻¹ b. With the linear rotation update, matrices are not orthonormal and are inverted; otherwise
// the transpose is used.
Matrix3<double> RelativeRotation(const Matrix3<double>& a, const Matrix3<double>& b);

// R_parent⁻¹ R of every bone; the root's parent is the fixed identity.
LocalRotations LocalRotationsOf(const BodyPose& pose);

// Mean angle between the local rotations of two poses, radians.
double MeanJointAngle(const BodyPose& a, const BodyPose& b);

// The whole body moved by `shift` (camera frame, metres).
BodyPose Translated(BodyPose pose, const Vector3d& shift);

// The whole body rotated about its root's centre.
BodyPose RotatedAboutRoot(BodyPose pose, const Matrix3<double>& rotation);

}  // namespace vitruvia::realtime_scape
