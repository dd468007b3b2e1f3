// Twist of each bone per rigid parameter of a PosedBody.
#pragma once

#include "fitting/angle_turns.h"

namespace vitruvia {

// For each bone one column per parameter before PosedBody::kShape: angular velocity, then velocity
// of the point of the bone that is at the world origin.
template <class Scalar>
using BoneTwists = std::array<Eigen::Matrix<Scalar, 6, Eigen::Dynamic>, kBoneCount>;

// `world_from_bone` are the bones' rotations, `joints` the posed joints.
template <class Scalar>
void FindTwists(const std::array<Matrix3<double>, kBoneCount>& world_from_bone,
                const std::vector<Vector3d>& joints, const AngleVector& angles_deg,
                BoneTwists<Scalar>& twists) {
  for (auto& of_bone : twists) of_bone.setZero(6, PosedBody::kShape);
  const auto add = [&](int bone, int parameter, const Vector3d& axis, const Vector3d& pivot) {
    twists[bone].col(parameter).template head<3>() += axis.template cast<Scalar>();
    twists[bone].col(parameter).template tail<3>() += pivot.cross(axis).template cast<Scalar>();
  };
  const std::vector<AngleTurn> turns = AngleTurns(angles_deg);
  for (int b = 0; b < kBoneCount; ++b) {
    for (int k = 0; k < 3; ++k) {
      add(b, PosedBody::kRotation + k, Vector3d::Unit(k), joints[0]);
      twists[b](3 + k, PosedBody::kPosition + k) = Scalar(1);
    }
    for (const AngleTurn& turn : turns) {
      int above = b;
      while (above >= 0 && above != turn.bone) above = Bones()[above].parent;
      if (above < 0) continue;
      add(b, PosedBody::kAngles + turn.angle,
          world_from_bone[Bones()[turn.bone].parent] * turn.axis, joints[turn.bone]);
    }
  }
}

}  // namespace vitruvia
