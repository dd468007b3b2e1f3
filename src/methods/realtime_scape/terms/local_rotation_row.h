// How far a bone's local rotation is from a reference, and how that depends on the unknowns.
#pragma once

#include <numbers>

#include "math/rotation.h"
#include "math/rotation_derivatives.h"
#include "methods/realtime_scape/body_pose.h"
#include "solver/block_normal_equations.h"

namespace vitruvia::realtime_scape {

// The other rotation vector of the same rotation, at an angle of π … 2π where the first is at 0 …
// π.
inline Vector3d OtherWayRound(const Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  return angle > 0.0 ? Vector3d(rotation_vector * (1.0 - 2.0 * std::numbers::pi / angle))
                     : rotation_vector;
}

// How a rotation vector of referenceᵀ R_parentᵀ R, in the reference's axes, depends on the
// unknowns.
class LocalDeviation {
 public:
  LocalDeviation(const BodyPose& pose, int bone, int parent, const Matrix3<double>& reference)
      : pose_(pose), bone_(bone), parent_(parent) {
    const Matrix3<double> local = RelativeRotation(pose[parent].rotation, pose[bone].rotation);
    vector_ = LogSo3<double>(reference.transpose() * local);
  }

  // At an angle of at most π.
  const Vector3d& vector() const { return vector_; }

  // Rows Σ_k (scale_k (vector_k − offset_k))², but for scales of 0. `vector` is vector() or its
  // other way round.
  void AddRows(const Vector3d& vector, const Vector3d& offset, const Vector3d& scale, double weight,
               BlockNormalEquations& equations) const {
    const Matrix3<double> by_bone =
        InverseRightJacobian(vector) * pose_[bone_].rotation.transpose();
    for (int axis = 0; axis < 3; ++axis) {
      if (scale[axis] == 0.0) continue;
      std::array<BlockNormalEquations::Entry, 2> entries;
      entries[0].block = bone_;
      entries[0].jacobian << scale[axis] * by_bone.row(axis).transpose(), Vector3d::Zero();
      entries[1].block = parent_;
      entries[1].jacobian << -scale[axis] * by_bone.row(axis).transpose(), Vector3d::Zero();
      equations.AddRow(entries, scale[axis] * (vector[axis] - offset[axis]), weight);
    }
  }

 private:
  const BodyPose& pose_;
  int bone_, parent_;
  Vector3d vector_;
};

}  // namespace vitruvia::realtime_scape
