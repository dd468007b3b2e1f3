// How far a bone's local rotation is from a reference, and how that depends on the unknowns.
#pragma once

#include "methods/realtime_scape/body_pose.h"
#include "solver/block_normal_equations.h"

namespace vitruvia::realtime_scape {

// The inverse of the right Jacobian of the exponential map: log(exp(d) exp(e)) ≈ d + J⁻¹(d) e.
inline Matrix3<double> InverseRightJacobian(const Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  const Matrix3<double> skew = Skew<double>(rotation_vector);
  const double second = angle < 1e-4 ? 1.0 / 12.0
                                     : 1.0 / (angle * angle) - (1.0 + std::cos(angle)) /
                                                                   (2.0 * angle * std::sin(angle));
  return Matrix3<double>::Identity() + 0.5 * skew + second * skew * skew;
}

// The rotation vector from a reference to a bone's local rotation R_parentᵀ R: of referenceᵀ R_local,
// in the reference's axes.
struct LocalDeviation {
  Vector3d vector;           // radians
  Matrix3<double> jacobian;  // by the bone's increment; by the parent's its negative

  LocalDeviation(const BodyPose& pose, int bone, int parent, const Matrix3<double>& reference) {
    const Matrix3<double>& rotation = pose[bone].rotation;
    const Matrix3<double> local = RelativeRotation(pose[parent].rotation, rotation);
    vector = LogSo3<double>(reference.transpose() * local);
    jacobian = InverseRightJacobian(vector) * rotation.transpose();
  }

  // One row: scale (direction · vector − offset).
  void AddRow(int bone, int parent, const Vector3d& direction, double offset, double scale,
              double weight, BlockNormalEquations& equations) const {
    const Vector3d by_bone = scale * jacobian.transpose() * direction;
    std::array<BlockNormalEquations::Entry, 2> entries;
    entries[0].block = bone;
    entries[0].jacobian << by_bone, Vector3d::Zero();
    entries[1].block = parent;
    entries[1].jacobian << -by_bone, Vector3d::Zero();
    equations.AddRow(entries, scale * (direction.dot(vector) - offset), weight);
  }
};

}  // namespace vitruvia::realtime_scape
