// The arms and legs of the skeleton.
#pragma once

#include <array>

#include "body/skeleton.h"

namespace vitruvia {

// The two bones of an arm or leg and the one that hangs from them.
struct Limb {
  BoneId upper, lower, end;
  // Axis of the hinge between upper and lower bone, rest pose; the limb bends by a positive angle
  // about it.
  Vector3<double> hinge;
};

inline constexpr int kLimbCount = 4;
const std::array<Limb, kLimbCount>& Limbs();

}  // namespace vitruvia
