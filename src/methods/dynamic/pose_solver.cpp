#include "methods/dynamic/pose_solver.h"

#include <algorithm>
#include <cmath>

namespace vitruvia::dynamic {

PoseSolver::PoseSolver(const KinematicTree& tree, const SkinWeights& weights)
    : moved_(tree.joint_count(), 0.0),
      observed_(tree.joint_count(), 0.0),
      is_held_(tree.joint_count(), 0) {
  std::array<double, kBoneCount> of_bone{};
  for (std::size_t v = 0; v < weights.size(); ++v) {
    for (int k = 0; k < kMaxInfluences; ++k) {
      of_bone[weights.bones[v][k]] += double{weights.weights[v][k]};
    }
  }
  for (int bone = 0; bone < kBoneCount; ++bone) {
    for (const int joint : tree.ChainOf(bone)) moved_[joint] += of_bone[bone];
  }
}

void PoseSolver::Hold(const KinematicTree& tree, const PoseEquations& equations,
                      const std::vector<char>& may_move, double held_below_share) {
  std::fill(observed_.begin(), observed_.end(), 0.0);
  for (int bone = 0; bone < kBoneCount; ++bone) {
    for (const int joint : tree.ChainOf(bone)) observed_[joint] += equations.observed[bone];
  }
  held_ = 0;
  for (int joint = 0; joint < tree.joint_count(); ++joint) {
    is_held_[joint] =
        may_move[joint] == 0 || observed_[joint] < held_below_share * moved_[joint] ? 1 : 0;
    held_ += is_held_[joint];
  }
}

StepSize PoseSolver::Step(const KinematicTree& tree, const PoseEquations& equations,
                          const std::vector<char>& may_move, const DampedStep& step,
                          Eigen::VectorXd& theta) {
  Hold(tree, equations, may_move, step.held_below_share);
  system_ = equations.hessian;
  step_ = equations.gradient;
  for (int k = 0; k < tree.joint_count(); ++k) {
    const double prior = step.default_pose_weight * tree.joints()[k].prior * moved_[k];
    system_(k, k) += step.damping + prior;
    step_[k] += prior * theta[k];
    if (is_held_[k] == 0) continue;
    system_.row(k).setZero();
    system_.col(k).setZero();
    system_(k, k) = 1.0;
    step_[k] = 0.0;
  }
  cholesky_.compute(system_);
  solved_ = cholesky_.info() == Eigen::Success && step_.allFinite();
  condition_ = solved_ ? 1.0 / cholesky_.rcond() : -1.0;
  StepSize size;
  if (!solved_) return size;
  cholesky_.solveInPlace(step_);
  solved_ = step_.allFinite();
  if (!solved_) return size;
  before_ = theta;
  theta -= step_;
  tree.Clamp(theta);
  for (int k = 0; k < tree.joint_count(); ++k) {
    double& largest =
        tree.joints()[k].type == JointType::kHinge ? size.rotation_rad : size.translation_m;
    largest = std::max(largest, std::abs(theta[k] - before_[k]));
  }
  return size;
}

}  // namespace vitruvia::dynamic
