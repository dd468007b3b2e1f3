// Fits pose, position and shape of a body to a target, from one start.
//
// Gauss–Newton on Σ w ρ(r) over pairs that are found again in each iteration (ρ: Geman–McClure with
// a shrinking width), with joint limits as bounds of the angles (an angle that a step would move
// beyond its limit is held at the limit, and the others are solved for again), and priors on angles
// and shape.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "fitting/fit_target.h"

namespace vitruvia {

// One stage of a fit, coarse or fine.
struct FitStage {
  int iterations = 10;
  double first_cutoff_m = 0.3, last_cutoff_m = 0.1;  // of a pair's distance
  double point_share = 0.2;  // weight of the squared distance in space; the rest is that of the
                             // distance along the normal
  bool moves_shape = false;
};

struct FitPriors {
  AngleVector angles_deg = AngleVector::Zero();  // mean of the prior on the pose
  double angle_deviation_deg = 40.0;
  Eigen::VectorXd theta;            // mean of the prior on the shape
  double point_deviation_m = 0.02;  // of a pair's residual
  double point_count = 300.0;       // effective number of independent points of all pairs
};

// Normal equations of the shape at a state, with pose and position eliminated (Schur complement),
// from the pairs and the pose's prior. Hx = −g for a step x; the shape's own prior is not included.
struct ShapeEquations {
  Eigen::MatrixXd hessian;
  Eigen::VectorXd gradient;
};

class PoseFit {
 public:
  // The body must outlive the fit.
  explicit PoseFit(const ShapedBody& body) : posed_(body) {}

  const ShapedBody& body() const { return posed_.body(); }

  BodyState Run(FitTarget& target, BodyState start, const FitStage& stage, const FitPriors& priors);
  // With pairs as in the last iteration of the stage.
  ShapeEquations EquationsOfShape(FitTarget& target, const BodyState& state, const FitStage& stage,
                                  const FitPriors& priors);
  MutualDistance Measure(FitTarget& target, const BodyState& state, const NearFar& limits);
  // The state translated so that the centroid of the body's visible part coincides with the
  // target's.
  BodyState Centered(FitTarget& target, BodyState state);

 private:
  struct Equations {
    Eigen::MatrixXd hessian;
    Eigen::VectorXd gradient;
  };
  void Assemble(const FitStage& stage, double robust_m, const FitPriors& priors);
  // Equations of the pairs within the cutoff and the priors on the angles; nothing if there are no
  // pairs.
  std::optional<Equations> EquationsAt(FitTarget& target, const BodyState& state, double cutoff_m,
                                       const FitStage& stage, const FitPriors& priors);

  PosedBody posed_;
  std::vector<FitPair> pairs_;
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows_;
  Eigen::VectorXf residuals_;
  Eigen::MatrixXf hessian_;
  Eigen::VectorXf gradient_;
};

}  // namespace vitruvia
