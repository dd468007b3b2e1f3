// Fits the pose to a frame: Gauss–Newton on a data term and a prior about the predicted pose,
// within the joint limits.
#pragma once

#include "articulated/data_term.h"
#include "articulated/settings.h"

namespace vitruvia::articulated {

struct PoseFitting {
  BodyState state;
  int iterations = 0;
  bool converged = false;
  bool solved = true;  // false: a step was not finite, and the state is that before this step
  Agreement agreement;
  double prior_energy = 0.0;  // before the last step
};

class PoseFitter {
 public:
  PoseFitter(const ShapedBody& body, const PinholeCamera& camera, const CommonSettings& settings,
             DataTerm& term)
      : settings_(settings), term_(term), bones_(body), view_(body, camera) {}

  // The data term must have observed the frame before.
  PoseFitting Fit(const Observation& observation, const BodyState& predicted, int iterations,
                  WorkerTeam& team, Clock& clock);
  Agreement Compare(const Observation& observation, const BodyState& state);
  // The state translated so that the mean of its visible surface lies at `center`.
  BodyState Centered(BodyState state, const Vector3d& center);

 private:
  Eigen::VectorXd Solve(const BodyState& state, const BodyState& predicted, double& prior_energy);

  CommonSettings settings_;
  DataTerm& term_;
  MovingBones bones_;
  ModelView view_;
  PoseSystem system_;
};

}  // namespace vitruvia::articulated
