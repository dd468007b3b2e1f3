// One step of the damped least squares over the joint values (paper B, sec. 4.2).
#pragma once

#include <vector>

#include <Eigen/Cholesky>

#include "methods/dynamic/kinematic_tree.h"
#include "methods/dynamic/pose_equations.h"

namespace vitruvia::dynamic {

// (JᵀJ + λI + γD) x = Jᵀr + γDθ; θ ← θ − x. D holds, for each joint, its prior's factor times the
// number of vertices that it moves.
struct DampedStep {
  double damping = 0.0;              // λ
  double default_pose_weight = 0.0;  // γ
  double held_below_share = 0.0;
};

struct StepSize {
  double rotation_rad = 0.0, translation_m = 0.0;  // largest of any joint
};

class PoseSolver {
 public:
  PoseSolver(const KinematicTree& tree, const SkinWeights& weights);

  // Solves by Cholesky and moves theta, within the joints' limits. Joints with `may_move` 0, or
  // with too few observed vertices, are held where they are. A system that is not positive definite
  // or not finite leaves theta as it was and makes `solved` false.
  StepSize Step(const KinematicTree& tree, const PoseEquations& equations,
                const std::vector<char>& may_move, const DampedStep& step, Eigen::VectorXd& theta);

  bool solved() const { return solved_; }
  double condition() const { return condition_; }  // of the solved system, an estimate; −1: none
  int held() const { return held_; }
  bool IsHeld(int joint) const { return is_held_[joint] != 0; }  // in the last step
  // Vertices that a joint moves: its bones' weights, summed.
  double MovedVertices(int joint) const { return moved_[joint]; }

 private:
  void Hold(const KinematicTree& tree, const PoseEquations& equations,
            const std::vector<char>& may_move, double held_below_share);

  std::vector<double> moved_, observed_;  // vertices, per joint
  std::vector<char> is_held_;
  Eigen::MatrixXd system_;
  Eigen::VectorXd step_, before_;
  Eigen::LLT<Eigen::MatrixXd> cholesky_;
  bool solved_ = false;
  double condition_ = -1.0;
  int held_ = 0;
};

}  // namespace vitruvia::dynamic
