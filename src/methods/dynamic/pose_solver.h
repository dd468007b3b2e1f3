// One step of the damped least squares over the joint values (paper B, sec. 4.2).
#pragma once

#include <vector>

#include <Eigen/Cholesky>

#include "methods/dynamic/kinematic_tree.h"
#include "methods/dynamic/pose_equations.h"

namespace vitruvia::dynamic {

// (JᵀJ + λI + γD) x = Jᵀr + γDθ; θ ← θ − x. D is diagonal: for each joint its prior's factor times
// the number of vertices that it moves.
struct PoseStepWeights {
  double damping = 0.0;              // λ
  double default_pose_weight = 0.0;  // γ
  double freeze_below_share = 0.0;   // joints with a smaller share of observed vertices are frozen
};

struct PoseStep {
  bool solved = false;               // false: theta is unchanged
  double rotation_rad = 0.0;         // largest change of a hinge
  double translation_m = 0.0;        // largest change of a prismatic joint
  double condition = -1.0;           // of the solved system, an estimate; -1: none
  double default_pose_energy = 0.0;  // γ θᵀDθ over all joints, before the step
};

class PoseSolver {
 public:
  PoseSolver(const KinematicTree& tree, const SkinWeights& weights);

  // Solves by Cholesky and moves theta, within the joints' limits. Joints with `may_move` 0, or
  // with too few observed vertices, are frozen: they keep their value. A system that is not
  // positive definite or not finite is not solved.
  PoseStep Step(const KinematicTree& tree, const PoseEquations& equations,
                const std::vector<char>& may_move, const PoseStepWeights& weights,
                Eigen::VectorXd& theta);

  // The Hessian JᵀJ + λI + γD of the last step's energy, including frozen joints.
  Eigen::MatrixXd Curvature(const KinematicTree& tree, const PoseEquations& equations,
                            const PoseStepWeights& weights) const;

  bool IsFrozen(int joint) const { return is_frozen_[joint] != 0; }  // in the last step
  // Vertices that a joint moves: its bones' weights, summed.
  double MovedVertices(int joint) const { return moved_[joint]; }

 private:
  void FreezeUnobservedJoints(const KinematicTree& tree, const PoseEquations& equations,
                              const std::vector<char>& may_move, double freeze_below_share);
  double BuildSystem(const KinematicTree& tree, const PoseEquations& equations,
                     const PoseStepWeights& weights, const Eigen::VectorXd& theta);
  double PriorOf(const KinematicTree& tree, int joint, const PoseStepWeights& weights) const;
  bool Solve(double& condition);

  std::vector<double> moved_, observed_;  // vertices, per joint
  std::vector<char> is_frozen_;
  Eigen::MatrixXd system_;
  Eigen::VectorXd step_, before_;
  Eigen::LLT<Eigen::MatrixXd> cholesky_;
};

}  // namespace vitruvia::dynamic
