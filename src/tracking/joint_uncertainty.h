// Uncertainty of a tracker's joints, from its normal equations and its sensor's noise.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "math/vector.h"
#include "tracking/depth_noise.h"
#include "tracking/tracker.h"

namespace vitruvia {

// A joint's covariance is C = inflation² σ_z² G H⁻¹ Gᵀ + model_deviation² I, where H are the normal
// equations at the frame's last linearisation in rows of unit noise, G is the joint's derivative
// with respect to the unknowns, and σ_z the standard deviation of depth at the joint. Terms that
// are not measurements enter H with their weights, like a prior. Inflation accounts for errors that
// rows share: correlated sensor noise and errors of the model's surface.
struct UncertaintySettings {
  double inflation = 0.0;  // 0: not estimated
  DepthNoise sensor{0.0012, 0.0019, 0.4, 0.0};
  double model_deviation_m = 0.01;
  double unreliable_above_m = 0.05;

  bool IsAsked() const { return inflation > 0.0; }
  void Describe(Fields& fields);
};

// G H⁻¹ Gᵀ of each joint: its covariance for rows of unit noise. Empty if H is not positive
// definite. `motions` stacks the matrices G, three rows for each joint.
std::vector<Matrix3<double>> UnitCovariances(const Eigen::MatrixXd& hessian,
                                             const Eigen::MatrixXd& motions);

// Fills the covariances and flags of a result whose outcome and joints are set. A joint is
// unreliable if the largest standard deviation of its covariance exceeds unreliable_above_m; all
// joints are unreliable if the frame failed or unit_covariances is empty.
void ReportUncertainty(const std::vector<Matrix3<double>>& unit_covariances,
                       const UncertaintySettings& settings, TrackResult& result);

}  // namespace vitruvia
