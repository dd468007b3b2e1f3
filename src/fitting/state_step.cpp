#include "fitting/state_step.h"

#include <algorithm>

#include <Eigen/Cholesky>

#include "math/angles.h"
#include "math/rotation.h"

namespace vitruvia {
namespace {

// Solves H x = −g for the free unknowns; the others keep their values of x.
void SolveFree(const Eigen::MatrixXd& hessian, const Eigen::VectorXd& gradient,
               const std::vector<int>& free, Eigen::VectorXd& x) {
  const auto n = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd h(n, n);
  Eigen::VectorXd g(n);
  Eigen::VectorXd held = x;
  for (const int i : free) held[i] = 0.0;
  const Eigen::VectorXd moved = gradient + hessian * held;
  for (Eigen::Index i = 0; i < n; ++i) {
    g[i] = moved[free[i]];
    for (Eigen::Index j = 0; j < n; ++j) h(i, j) = hessian(free[i], free[j]);
  }
  const Eigen::VectorXd solution = h.ldlt().solve(-g);
  for (Eigen::Index i = 0; i < n; ++i) x[free[i]] = solution[i];
}

}  // namespace

Eigen::VectorXd SolveWithinLimits(const Eigen::MatrixXd& hessian, const Eigen::VectorXd& gradient,
                                  const AngleVector& angles_deg, int free_count) {
  std::vector<int> free;
  for (int k = 0; k < free_count; ++k) free.push_back(k);
  Eigen::VectorXd step = Eigen::VectorXd::Zero(gradient.size());
  const AngleRanges& limits = JointLimits();
  constexpr int kMostRounds = 4;  // of holding angles at their limits
  for (int round = 0; round < kMostRounds; ++round) {
    SolveFree(hessian, gradient, free, step);
    std::vector<int> still_free;
    for (const int k : free) {
      const int a = k - PosedBody::kAngles;
      if (a < 0 || a >= kAngleCount) {
        still_free.push_back(k);
        continue;
      }
      const double lowest = kRadiansPerDegree * (limits.min_deg[a] - angles_deg[a]);
      const double highest = kRadiansPerDegree * (limits.max_deg[a] - angles_deg[a]);
      if (step[k] >= lowest && step[k] <= highest) still_free.push_back(k);
      step[k] = std::clamp(step[k], lowest, highest);
    }
    if (still_free.size() == free.size()) break;
    free = std::move(still_free);
  }
  return step;
}

Eigen::VectorXd NoLongerThanLinear(Eigen::VectorXd step) {
  constexpr double kLongest = 0.6;  // rad, m
  const double longest = step.head(PosedBody::kShape).cwiseAbs().maxCoeff();
  if (longest > kLongest) step *= kLongest / longest;
  return step;
}

BodyState Moved(BodyState state, const Eigen::VectorXd& step) {
  state.rotation = ExpSo3<double>(step.segment<3>(PosedBody::kRotation)) * state.rotation;
  state.pelvis_position += step.segment<3>(PosedBody::kPosition);
  state.angles_deg = WithinLimits(state.angles_deg + step.segment<kAngleCount>(PosedBody::kAngles) /
                                                         kRadiansPerDegree);
  if (step.size() > PosedBody::kShape) state.theta += step.tail(state.theta.size());
  return state;
}

}  // namespace vitruvia
