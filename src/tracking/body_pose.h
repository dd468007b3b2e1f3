// The pose of a body as a rigid motion of each bone: that which Realtime SCAPE estimates, and in
// which limbs are searched.
#pragma once

#include <array>

#include "body/skeleton.h"
#include "geometry/mesh.h"

namespace vitruvia {

// A bone's rotation is about a centre of its own (in Realtime SCAPE the weighted mean of its
// vertices), not about the subject's origin on the floor: the energy is the same, but a rotation
// step of the head does not translate it by metres, so the thresholds of the stopping rule are
// comparable between bones and the equations are better conditioned.
struct BonePose {
  Matrix3<double> rotation = Matrix3<double>::Identity();  // camera_from_rest
  Vector3<double> center = Vector3<double>::Zero();        // camera frame, metres
};
using BodyPose = std::array<BonePose, kBoneCount>;

// a⁻¹ b. With the linear rotation update, matrices are not orthonormal and are inverted; otherwise
// the transpose is used.
Matrix3<double> RelativeRotation(const Matrix3<double>& a, const Matrix3<double>& b);

}  // namespace vitruvia
