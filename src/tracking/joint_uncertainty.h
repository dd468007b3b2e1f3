// Uncertainty of a tracker's joints, from its normal equations and its sensor's noise.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "math/vector.h"
#include "tracking/depth_noise.h"
#include "tracking/tracker.h"

namespace vitruvia {

// A joint's covariance is C = (inflation (1 + f (1 − s)))² σ_z² G H⁻¹ Gᵀ + (m² + (b φ)² + (a d)² +
// l²) I. H are the normal equations at the frame's last linearisation in rows of unit noise, G is
// the joint's derivative with respect to the unknowns, and σ_z the standard deviation of depth at
// the joint. Terms that are not measurements enter H with their weights, like a prior. Inflation
// accounts for errors that rows share: correlated sensor noise and errors of the model's surface.
// It grows by f = unconfirmed_inflation with the unconfirmed share 1 − s of the joint's bone. m is
// model_deviation_m, b is bend_deviation_m for the angle φ by which the joint is bent, since skin
// deviates from the model's most at bent joints, a is disagreement_deviation_m for the share d of
// area in which frame and model disagree, and l is lost_deviation_m in a frame that failed,
// otherwise 0.
struct UncertaintySettings {
  double inflation = 0.0;  // 0: not estimated
  double unconfirmed_inflation = 0.0;
  DepthNoise sensor{0.0012, 0.0019, 0.4, 0.0};
  double model_deviation_m = 0.01;
  double bend_deviation_m = 0.0;  // per radian
  double disagreement_deviation_m = 0.0;
  double lost_deviation_m = 0.05;
  double unreliable_above_m = 0.05;

  bool IsAsked() const { return inflation > 0.0; }
  void Describe(Fields& fields);
};

// What a frame and a pose say of the bones at a joint.
struct JointSupport {
  double confirmed = 1.0;     // share of the visible vertices of the joint's bone
  double disagreement = 0.0;  // BoneAreas::disagreement() of the bone or its parent, the larger one
  double bend_rad = 0.0;      // from the rest pose, of the joint or its parent's, the larger one
};

// G H⁻¹ Gᵀ of each joint: its covariance for rows of unit noise. Empty if H is not positive
// definite. `motions` stacks the matrices G, three rows for each joint.
std::vector<Matrix3<double>> UnitCovariances(const Eigen::MatrixXd& hessian,
                                             const Eigen::MatrixXd& motions);

// Fills the covariances and flags of a result whose outcome and joints are set. A joint is
// unreliable if the largest standard deviation of its covariance exceeds unreliable_above_m; all
// joints are unreliable if unit_covariances is empty. `supports`: of each joint; empty: full.
void ReportUncertainty(const std::vector<Matrix3<double>>& unit_covariances,
                       const std::vector<JointSupport>& supports,
                       const UncertaintySettings& settings, TrackResult& result);

}  // namespace vitruvia
