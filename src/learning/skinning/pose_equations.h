// Linearised transforms of one pose: each bone rotates by a small rotation vector r about the
// origin of its frame, in the posed axes, and moves by t, R ← exp(r̂) R, T ← T + t.
//
// A step holds (r, t) of every bone, 6B numbers. A pose block is [R | T]ᵀ of all bones (4B × 3, one
// pose of a BoneStack).
#pragma once

#include <vector>

#include "learning/skinning/bone_pattern.h"
#include "learning/skinning/bone_stack.h"

namespace vitruvia::skinning {

using PoseBlock = Eigen::Matrix<double, Eigen::Dynamic, 3>;  // 4B × 3
using ConstPose = Eigen::Ref<const PoseBlock>;
using MutablePose = Eigen::Ref<PoseBlock>;
using ConstStep = Eigen::Ref<const Eigen::VectorXd>;
using MutableStep = Eigen::Ref<Eigen::VectorXd>;

// The change of the pose block to first order in the step, and its adjoint: ⟨change, pull⟩ =
// ⟨step, adjoint⟩.
void Differential(const ConstPose& pose, const ConstStep& step, MutablePose change);
void Adjoint(const ConstPose& pose, const ConstPose& pull, MutableStep adjoint);

// The pose after the step; rotations stay proper.
void Move(const ConstPose& pose, const ConstStep& step, MutablePose moved);

// The normal equations of the change Σ_j w_j (r_j × R_j v̄ + t_j) of the vertices in a step.
class PoseEquations {
 public:
  // Bones without vertices get an identity block, so they do not move.
  void Linearise(const BonePattern& pattern, const Eigen::MatrixXd& second, const ConstPose& pose);
  // Factorises with the diagonal scaled by 1 + damping. False if the matrix is not positive
  // definite.
  bool Factor(const BonePattern& pattern, double damping);
  void SolveInPlace(const BonePattern& pattern, MutableStep step) const {
    cholesky_.SolveInPlace(pattern, step);
  }
  // The diagonal before it is raised, bone by bone.
  void Diagonal(const BonePattern& pattern, MutableStep diagonal) const;

 private:
  std::vector<Matrix6> normal_, damped_;  // in the pattern's slots
  BoneCholesky cholesky_;
};

}  // namespace vitruvia::skinning
