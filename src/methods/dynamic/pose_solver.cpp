#include "methods/dynamic/pose_solver.h"

#include <algorithm>
#include <cmath>

namespace vitruvia::dynamic {

PoseSolver::PoseSolver(const KinematicTree& tree, const SkinWeights& weights)
    : moved_(tree.joint_count(), 0.0),
      observed_(tree.joint_count(), 0.0),
      is_frozen_(tree.joint_count(), 0) {
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

void PoseSolver::FreezeUnobservedJoints(const KinematicTree& tree, const PoseEquations& equations,
                                        const std::vector<char>& may_move,
                                        double freeze_below_share) {
  std::fill(observed_.begin(), observed_.end(), 0.0);
  for (int bone = 0; bone < kBoneCount; ++bone) {
    for (const int joint : tree.ChainOf(bone)) observed_[joint] += equations.observed[bone];
  }
  for (int joint = 0; joint < tree.joint_count(); ++joint) {
    const bool is_unobserved = observed_[joint] < freeze_below_share * moved_[joint];
    is_frozen_[joint] = may_move[joint] == 0 || is_unobserved ? 1 : 0;
  }
}

// Returns the energy of the default-pose prior.
double PoseSolver::BuildSystem(const KinematicTree& tree, const PoseEquations& equations,
                               const PoseStepWeights& weights, const Eigen::VectorXd& theta) {
  system_ = equations.hessian;
  step_ = equations.gradient;
  double default_pose_energy = 0.0;
  for (int k = 0; k < tree.joint_count(); ++k) {
    const double prior = PriorOf(tree, k, weights);
    default_pose_energy += prior * theta[k] * theta[k];
    system_(k, k) += weights.damping + prior;
    step_[k] += prior * theta[k];
    if (is_frozen_[k] == 0) continue;
    system_.row(k).setZero();
    system_.col(k).setZero();
    system_(k, k) = 1.0;
    step_[k] = 0.0;
  }
  return default_pose_energy;
}

Eigen::MatrixXd PoseSolver::Curvature(const KinematicTree& tree, const PoseEquations& equations,
                                      const PoseStepWeights& weights) const {
  Eigen::MatrixXd curvature = equations.hessian;
  for (int k = 0; k < tree.joint_count(); ++k)
    curvature(k, k) += weights.damping + PriorOf(tree, k, weights);
  return curvature;
}

// Of one joint: γD.
double PoseSolver::PriorOf(const KinematicTree& tree, int joint,
                           const PoseStepWeights& weights) const {
  return weights.default_pose_weight * tree.joints()[joint].prior * moved_[joint];
}

// Turns the right-hand side into the step.
bool PoseSolver::Solve(double& condition) {
  cholesky_.compute(system_);
  if (cholesky_.info() != Eigen::Success || !step_.allFinite()) return false;
  condition = 1.0 / cholesky_.rcond();
  cholesky_.solveInPlace(step_);
  return step_.allFinite();
}

PoseStep PoseSolver::Step(const KinematicTree& tree, const PoseEquations& equations,
                          const std::vector<char>& may_move, const PoseStepWeights& weights,
                          Eigen::VectorXd& theta) {
  PoseStep result;
  FreezeUnobservedJoints(tree, equations, may_move, weights.freeze_below_share);
  result.default_pose_energy = BuildSystem(tree, equations, weights, theta);
  result.solved = Solve(result.condition);
  if (!result.solved) return result;
  before_ = theta;
  theta -= step_;
  tree.Clamp(theta);
  for (int k = 0; k < tree.joint_count(); ++k) {
    double& largest =
        tree.joints()[k].type == JointType::kHinge ? result.rotation_rad : result.translation_m;
    largest = std::max(largest, std::abs(theta[k] - before_[k]));
  }
  return result;
}

}  // namespace vitruvia::dynamic
