// Deviation of a bone's local rotation from a reference, and its derivatives with respect to the
// unknowns.
#pragma once

#include <numbers>

#include "math/rotation.h"
#include "math/rotation_derivatives.h"
#include "methods/realtime_scape/body_pose.h"
#include "solver/block_normal_equations.h"

namespace vitruvia::realtime_scape {

// The other rotation vector of the same rotation: its angle is in π … 2π if the given one is in 0 …
// π.
inline Vector3d OtherWayRound(const Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  return angle > 0.0 ? Vector3d(rotation_vector * (1.0 - 2.0 * std::numbers::pi / angle))
                     : rotation_vector;
}

// The rotation vector of referenceᵀ R_parentᵀ R, in the reference's axes, as a function of the
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

  // Adds rows Σ_k (scale_k (vector_k − offset_k))² for the non-zero scales. `vector` is vector() or
  // OtherWayRound(vector()).
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
