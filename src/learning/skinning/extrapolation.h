// Anderson's acceleration of the alternation, seen as a fixed-point iteration of the transforms.
#pragma once

#include <vector>

#include "learning/skinning/bone_stack.h"

namespace vitruvia::skinning {

class Extrapolation {
 public:
  Extrapolation(int bones, int poses, int history);

  void Forget() { count_ = 0; }

  // `before` went into an alternation and `after` came out. Replaces `next` by the combination of
  // all such pairs kept whose residual (after − before) moves the vertices least; `second` measures
  // how far (SkinMoments). Rotations are not proper afterwards. False, and `next` is `after`, if
  // there is nothing to extrapolate from.
  bool Extrapolate(const BoneStack& before, const BoneStack& after, const Eigen::MatrixXd& second,
                   BoneStack& next);

 private:
  int history_;
  int count_ = 0;                              // pairs seen since Forget()
  std::vector<BoneStack> afters_, residuals_;  // ring buffers of history + 1
  BoneStack moved_, difference_;
};

}  // namespace vitruvia::skinning
