#include "articulated/moving_bones.h"

#include "math/rigid.h"

namespace vitruvia::articulated {

void MovingBones::Set(const BodyState& state) {
  state_ = state;
  camera_from_rest_ = WorldFromRest(body_, state);
}

void MovingBones::Differentiate() {
  std::array<Matrix3<double>, kBoneCount> rotations;
  for (int b = 0; b < kBoneCount; ++b) rotations[b] = camera_from_rest_[b].rotation;
  FindTwists<double>(rotations, PosedJoints(body_.skeleton, camera_from_rest_), state_.angles_deg,
                     twists_);
}

}  // namespace vitruvia::articulated
