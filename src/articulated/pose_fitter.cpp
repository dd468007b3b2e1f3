#include "articulated/pose_fitter.h"

#include <algorithm>
#include <cmath>

#include "fitting/state_step.h"
#include "math/angles.h"
#include "math/rotation.h"

namespace vitruvia::articulated {
namespace {

using Parameters = Eigen::Matrix<double, kParameterCount, 1>;

constexpr int kRotation = PosedBody::kRotation, kPosition = PosedBody::kPosition,
              kAngles = PosedBody::kAngles;

// Difference of two states in the parameters of the bones.
Parameters Difference(const BodyState& state, const BodyState& from) {
  Parameters difference;
  const Matrix3<double> turn = state.rotation * from.rotation.transpose();
  difference.segment<3>(kRotation) = LogSo3<double>(turn);
  difference.segment<3>(kPosition) = state.pelvis_position - from.pelvis_position;
  difference.segment<kAngleCount>(kAngles) =
      kRadiansPerDegree * (state.angles_deg - from.angles_deg);
  return difference;
}

Parameters Stiffness(const PredictionSettings& settings) {
  const auto of = [](double deviation) { return 1.0 / (deviation * deviation); };
  Parameters stiffness;
  stiffness.segment<3>(kRotation).setConstant(
      of(settings.rotation_deviation_deg * kRadiansPerDegree));
  stiffness.segment<3>(kPosition).setConstant(of(settings.position_deviation_m));
  stiffness.segment<kAngleCount>(kAngles).setConstant(
      of(settings.angle_deviation_deg * kRadiansPerDegree));
  return stiffness;
}

}  // namespace

Eigen::VectorXd PoseFitter::Solve(const BodyState& state, const BodyState& predicted,
                                  double& prior_energy) {
  const Parameters stiffness = Stiffness(settings_.prediction);
  const Parameters away = Difference(state, predicted);
  prior_energy = stiffness.dot(away.cwiseAbs2());
  Eigen::MatrixXd hessian = system_.hessian();
  hessian.diagonal() += stiffness;
  const Eigen::VectorXd gradient = system_.gradient() + stiffness.cwiseProduct(away);
  return SolveWithinLimits(hessian, gradient, state.angles_deg, kParameterCount);
}

PoseFitting PoseFitter::Fit(const Observation& observation, const BodyState& predicted,
                            int iterations, WorkerTeam& team, Clock& clock) {
  PoseFitting fit;
  fit.state = predicted;
  bones_.Set(fit.state);
  term_.Begin(bones_);
  while (fit.iterations < iterations && !fit.converged && fit.solved) {
    bones_.Set(fit.state);
    bones_.Differentiate();
    system_.Reset();
    clock.Lap(TimedStep::kPose);
    const double progress = iterations > 1 ? fit.iterations / (iterations - 1.0) : 1.0;
    term_.AddRows(bones_, progress, team, clock, system_);
    system_.Reduce(bones_.twists());
    clock.Lap(TimedStep::kAssemble);
    Eigen::VectorXd step = Solve(fit.state, predicted, fit.prior_energy);
    clock.Lap(TimedStep::kSolve);
    ++fit.iterations;
    fit.solved = step.allFinite();
    if (!fit.solved) break;
    step = NoLongerThanLinear(std::move(step));
    fit.state = Moved(std::move(fit.state), step);
    const double turned = std::max(step.segment<3>(kRotation).norm(),
                                   step.segment<kAngleCount>(kAngles).cwiseAbs().maxCoeff());
    fit.converged = turned < settings_.stopping.rotation_step_deg * kRadiansPerDegree &&
                    step.segment<3>(kPosition).norm() < settings_.stopping.translation_step_m;
  }
  // Orthonormalised, so that rounding errors do not accumulate over many steps.
  fit.state.rotation = NearestRotation(fit.state.rotation);
  fit.agreement = Compare(observation, fit.state);
  clock.Lap(TimedStep::kAgreement);
  return fit;
}

Agreement PoseFitter::Compare(const Observation& observation, const BodyState& state) {
  bones_.Set(state);
  view_.Look(bones_.camera_from_rest());
  return view_.Compare(*observation.depth, *observation.cloud, settings_.near_m);
}

BodyState PoseFitter::Centered(BodyState state, const Vector3d& center) {
  constexpr int kRounds = 2;  // moving the body changes what is visible of it
  for (int round = 0; round < kRounds; ++round) {
    bones_.Set(state);
    view_.Look(bones_.camera_from_rest());
    state.pelvis_position += center - view_.VisibleCentroid();
  }
  return state;
}

}  // namespace vitruvia::articulated
