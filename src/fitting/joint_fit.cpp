#include "fitting/joint_fit.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Cholesky>

#include "core/error.h"
#include "fitting/state_step.h"
#include "math/angles.h"
#include "math/rotation.h"

namespace vitruvia {
namespace {

constexpr int kParameters = PosedBody::kShape;  // without the shape

// Known minus posed, one after the other.
Eigen::VectorXd Residuals(const ShapedBody& body, const BodyState& state,
                          const KnownJoints& known) {
  const std::vector<Vector3d> joints =
      PosedJoints(ShapedSkeleton(body, state.theta), WorldFromRest(body, state));
  Eigen::VectorXd residuals(3 * static_cast<Eigen::Index>(known.joints.size()));
  for (std::size_t k = 0; k < known.joints.size(); ++k) {
    residuals.segment<3>(static_cast<Eigen::Index>(3 * k)) =
        known.joints[k].position - joints[static_cast<std::size_t>(known.joints[k].joint)];
  }
  return residuals;
}

// The start rotated about the vertical axis through the pelvis, and translated, to best match the
// known joints.
BodyState Placed(const ShapedBody& body, const BodyState& start, const KnownJoints& known) {
  constexpr int kDirections = 24;
  BodyState best;
  double least = std::numeric_limits<double>::infinity();
  for (int d = 0; d < kDirections; ++d) {
    BodyState state = start;
    state.rotation =
        ExpSo3<double>({0.0, 2.0 * std::numbers::pi * d / kDirections, 0.0}) * start.rotation;
    const Eigen::VectorXd apart = Residuals(body, state, known);
    const Vector3d mean = apart.reshaped(3, apart.size() / 3).rowwise().mean();
    state.pelvis_position += mean;
    const double squared = Residuals(body, state, known).squaredNorm();
    if (squared >= least) continue;
    least = squared;
    best = std::move(state);
  }
  return best;
}

Eigen::MatrixXd Jacobian(const ShapedBody& body, const BodyState& state, const KnownJoints& known,
                         const Eigen::VectorXd& residuals) {
  constexpr double kStep = 1e-5;  // rad, m
  Eigen::MatrixXd jacobian(residuals.size(), kParameters);
  for (int p = 0; p < kParameters; ++p) {
    Eigen::VectorXd step = Eigen::VectorXd::Zero(kParameters);
    step[p] = kStep;
    jacobian.col(p) = (residuals - Residuals(body, Moved(state, step), known)) / kStep;
  }
  return jacobian;
}

}  // namespace

BodyState FittedToJoints(const ShapedBody& body, const BodyState& start, const KnownJoints& known,
                         double angle_deviation_deg) {
  Require(!known.joints.empty(), "FittedToJoints: no joints");
  constexpr int kIterations = 10;
  const double weight = 1.0 / (known.deviation_m * known.deviation_m);
  const double stiffness = 1.0 / std::pow(angle_deviation_deg * kRadiansPerDegree, 2);
  const AngleVector expected_deg = start.angles_deg;
  BodyState state = Placed(body, start, known);
  for (int i = 0; i < kIterations; ++i) {
    const Eigen::VectorXd residuals = Residuals(body, state, known);
    const Eigen::MatrixXd jacobian = Jacobian(body, state, known, residuals);
    Eigen::MatrixXd hessian = weight * jacobian.transpose() * jacobian;
    Eigen::VectorXd gradient = weight * jacobian.transpose() * residuals;
    constexpr double kDamping = 1.0;  // for rotations that a single joint does not determine
    hessian.diagonal().array() += kDamping;
    hessian.diagonal().tail<kAngleCount>().array() += stiffness;
    gradient.tail<kAngleCount>() +=
        stiffness * kRadiansPerDegree * (expected_deg - state.angles_deg);
    state = Moved(std::move(state), NoLongerThanLinear(hessian.ldlt().solve(gradient)));
  }
  return state;
}

}  // namespace vitruvia
