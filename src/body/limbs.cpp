#include "body/limbs.h"

namespace vitruvia {

const std::array<Limb, kLimbCount>& Limbs() {
  using enum BoneId;
  static const std::array<Limb, kLimbCount> limbs{{
      {kLeftUpperArm, kLeftForearm, kLeftHand, -Vector3<double>::UnitY()},
      {kRightUpperArm, kRightForearm, kRightHand, Vector3<double>::UnitY()},
      {kLeftThigh, kLeftShin, kLeftFoot, Vector3<double>::UnitX()},
      {kRightThigh, kRightShin, kRightFoot, Vector3<double>::UnitX()},
  }};
  return limbs;
}

}  // namespace vitruvia
