// Limits of each bone's rotation relative to its parent, from the ranges of the anatomical joints.
#pragma once

#include <array>

#include "body/skeleton.h"

namespace vitruvia {

// Limits of the components of the rotation vector of a bone's local rotation (rest axes, radians);
// infinite if there is no limit.
struct BoneLimits {
  Vector3<double> min_rad, max_rad;

  bool HasAny() const {
    return min_rad.array().isFinite().any() || max_rad.array().isFinite().any();
  }
};

// In the order of BoneId. A trunk's range is shared evenly by abdomen and chest, a neck's by neck
// and head, a forearm's pronation by forearm and hand (as in a motion file's pose). Elbows and
// knees are limited about their hinges alone, hips as the components of one rotation vector;
// shoulders, whose swing reaches every direction, and the pelvis are not limited.
const std::array<BoneLimits, kBoneCount>& LimitsOfBones();

}  // namespace vitruvia
