// The bones of a body in a state, and how they move with the state's parameters.
//
// The parameters are those of PosedBody (fitting/shaped_body.h) without shape: a rotation vector of
// the whole body about the pelvis joint (camera frame, rad), the pelvis' position (m), the
// anatomical angles (rad).
#pragma once

#include "fitting/bone_twists.h"

namespace vitruvia::articulated {

inline constexpr int kParameterCount = PosedBody::kShape;

class MovingBones {
 public:
  // The body must outlive this object.
  explicit MovingBones(const ShapedBody& body) : body_(body) {}

  // State in the camera frame.
  void Set(const BodyState& state);
  const BodyState& state() const { return state_; }
  const BoneTransforms& camera_from_rest() const { return camera_from_rest_; }

  // Prepares twists() at the state last set.
  void Differentiate();
  const BoneTwists<double>& twists() const { return twists_; }

 private:
  const ShapedBody& body_;
  BodyState state_;
  BoneTransforms camera_from_rest_;
  BoneTwists<double> twists_;
};

}  // namespace vitruvia::articulated
