// A step of all bones in all poses with the weights eliminated, which accelerates the alternation.
//
// An alternation alone converges slowly if weights and transforms are strongly coupled. Here the
// weights are eliminated instead of held constant (variable projection): the part of a vertex's
// change J ξ under a step ξ of all transforms that its free weights can compensate does not count.
// The normal matrix Σ Jᵀ (I − A (AᵀA)⁻¹ Aᵀ) J couples all poses, 6BP unknowns. It is never formed:
// conjugate gradients need its products only, with the poses' own normal matrices as
// preconditioner. A product does not read the examples. A vertex's share of it follows from the
// products of bones' places summed over poses, which are quadratic forms in its rest point; so one
// product costs V small forms and three matrix products of size 4B × 3P.
#pragma once

#include <vector>

#include "core/worker_team.h"
#include "learning/skinning/packed_examples.h"
#include "learning/skinning/pose_equations.h"
#include "learning/skinning/weight_step.h"

namespace vitruvia::skinning {

class JointStep {
 public:
  JointStep(const PackedExamples& examples, int bones, int iterations, WorkerTeam& team);
  ~JointStep();

  // `moments` and `weights` belong to `stack`, and the weights are the best for it. Replaces `next`
  // by the stack after the step. Larger damping (relative to the diagonal) makes shorter steps.
  void Solve(const BonePattern& pattern, const SkinMoments& moments, const RowWeights& weights,
             const BoneStack& stack, double damping, BoneStack& next);

 private:
  struct VertexTerms;
  struct Chunk;
  using Steps = Eigen::MatrixXd;  // 6B × P, a step per column

  bool Prepare(const BonePattern& pattern, const SkinMoments& moments, const RowWeights& weights,
               const BoneStack& stack, double damping);
  void SetUpTerms(const RowWeights& weights, const BoneStack& stack);
  void Multiply(const SkinMoments& moments, const BoneStack& stack, double damping,
                const Steps& steps);
  void GatherUndone(const BoneStack& stack);
  void Precondition(const BonePattern& pattern);

  const PackedExamples& examples_;
  int bones_, iterations_;
  WorkerTeam& team_;
  std::vector<PoseEquations> equations_;  // per pose
  std::vector<VertexTerms> terms_;        // of vertices with two influences or more
  std::vector<Chunk> chunks_;
  Eigen::MatrixXd products_;  // stack · changeᵀ, 4B × 4B
  Eigen::MatrixXd undone_;    // what the weights undo is undone_ · stack, 4B × 4B
  BoneStack change_, pull_;
  Steps diagonal_, solution_, residual_, preconditioned_, direction_, product_;
};

}  // namespace vitruvia::skinning
