#include "fitting/pose_fit.h"

#include <cmath>

#include <Eigen/Cholesky>

#include "fitting/state_step.h"
#include "math/angles.h"

namespace vitruvia {
namespace {

constexpr int kRows = 256;  // added as one product

double Cutoff(const FitStage& stage, int iteration) {
  if (stage.iterations < 2) return stage.last_cutoff_m;
  return stage.first_cutoff_m *
         std::pow(stage.last_cutoff_m / stage.first_cutoff_m, iteration / (stage.iterations - 1.0));
}

}  // namespace

void PoseFit::Assemble(const FitStage& stage, double robust_m, const FitPriors& priors) {
  const int columns = posed_.parameter_count();
  rows_.resize(kRows, columns);
  residuals_.resize(kRows);
  hessian_.setZero(columns, columns);
  gradient_.setZero(columns);
  const auto robust = static_cast<float>(robust_m);
  const auto point_share = static_cast<float>(stage.point_share);
  const float plane_share = 1.0f - point_share, point_root = std::sqrt(point_share);
  const float scale = static_cast<float>(
      std::sqrt(priors.point_count / std::max<double>(1.0, static_cast<double>(pairs_.size()))) /
      priors.point_deviation_m);
  int filled = 0;
  const auto flush = [&] {
    const auto block = rows_.topRows(filled);
    hessian_.selfadjointView<Eigen::Lower>().rankUpdate(block.transpose());
    gradient_.noalias() += block.transpose() * residuals_.head(filled);
    filled = 0;
  };
  const auto add = [&](int vertex, const Vector3f& n, float weight, float residual) {
    posed_.Row(vertex, n, rows_.row(filled).data());
    rows_.row(filled) *= weight;
    residuals_[filled] = weight * residual;
    if (++filled == kRows) flush();
  };
  for (const FitPair& pair : pairs_) {
    const Vector3f d = posed_.vertices()[static_cast<std::size_t>(pair.vertex)] - pair.target;
    const float along = pair.normal.dot(d);
    const float squared = plane_share * along * along + point_share * d.squaredNorm();
    const float weight = scale * std::sqrt(pair.weight) / (1.0f + squared / (robust * robust));
    if (point_share == 0.0f) {
      add(pair.vertex, pair.normal, weight, along);
      continue;
    }
    // The columns of the root of plane_share n nᵀ + point_share I.
    for (int k = 0; k < 3; ++k) {
      const Vector3f direction =
          point_root * Vector3f::Unit(k) + (1.0f - point_root) * pair.normal[k] * pair.normal;
      add(pair.vertex, direction, weight, direction.dot(d));
    }
  }
  if (filled > 0) flush();
}

std::optional<PoseFit::Equations> PoseFit::EquationsAt(FitTarget& target, const BodyState& state,
                                                       double cutoff_m, const FitStage& stage,
                                                       const FitPriors& priors) {
  posed_.Set(state);
  target.FindPairs(posed_, cutoff_m, pairs_);
  if (pairs_.empty()) return std::nullopt;
  posed_.Differentiate();
  Assemble(stage, 0.5 * cutoff_m, priors);
  Equations equations{hessian_.cast<double>().selfadjointView<Eigen::Lower>(),
                      gradient_.cast<double>()};
  constexpr double kDamping = 1e-3;
  equations.hessian.diagonal().array() += kDamping;
  const double stiffness = 1.0 / std::pow(priors.angle_deviation_deg * kRadiansPerDegree, 2);
  for (int a = 0; a < kAngleCount; ++a) {
    const int at = PosedBody::kAngles + a;
    equations.hessian(at, at) += stiffness;
    equations.gradient[at] +=
        stiffness * kRadiansPerDegree * (state.angles_deg[a] - priors.angles_deg[a]);
  }
  return equations;
}

BodyState PoseFit::Run(FitTarget& target, BodyState state, const FitStage& stage,
                       const FitPriors& priors) {
  const int columns = posed_.parameter_count();
  for (int i = 0; i < stage.iterations; ++i) {
    std::optional<Equations> equations =
        EquationsAt(target, state, Cutoff(stage, i), stage, priors);
    if (!equations) break;
    for (int k = PosedBody::kShape; k < columns; ++k) {
      equations->hessian(k, k) += 1.0;
      equations->gradient[k] +=
          state.theta[k - PosedBody::kShape] - priors.theta[k - PosedBody::kShape];
    }
    const Eigen::VectorXd step =
        SolveWithinLimits(equations->hessian, equations->gradient, state.angles_deg,
                          stage.moves_shape ? columns : int{PosedBody::kShape});
    state = Moved(std::move(state), NoLongerThanLinear(step));
  }
  return state;
}

ShapeEquations PoseFit::EquationsOfShape(FitTarget& target, const BodyState& state,
                                         const FitStage& stage, const FitPriors& priors) {
  constexpr int kPose = PosedBody::kShape;
  const int shape = posed_.body().shape_count();
  const auto equations = EquationsAt(target, state, stage.last_cutoff_m, stage, priors);
  if (!equations) return {Eigen::MatrixXd::Zero(shape, shape), Eigen::VectorXd::Zero(shape)};
  const Eigen::MatrixXd& h = equations->hessian;
  const Eigen::LDLT<Eigen::MatrixXd> pose(h.topLeftCorner(kPose, kPose));
  const Eigen::MatrixXd across = h.topRightCorner(kPose, shape);
  return {h.bottomRightCorner(shape, shape) - across.transpose() * pose.solve(across),
          equations->gradient.tail(shape) -
              across.transpose() * pose.solve(equations->gradient.head(kPose))};
}

MutualDistance PoseFit::Measure(FitTarget& target, const BodyState& state, const NearFar& limits) {
  posed_.Set(state);
  return target.Measure(posed_, limits);
}

BodyState PoseFit::Centered(FitTarget& target, BodyState state) {
  posed_.Set(state);
  state.pelvis_position += target.Center() - target.VisibleCenter(posed_);
  return state;
}

}  // namespace vitruvia
