#include "support/ceres_adaptor.h"

#include <ceres/ceres.h>

namespace vitruvia {
namespace {

struct Functor {
  const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>* residuals;
  int unknowns;

  bool operator()(double const* const* parameters, double* out) const {
    const Eigen::VectorXd r =
        (*residuals)(Eigen::Map<const Eigen::VectorXd>(parameters[0], unknowns));
    std::copy(r.data(), r.data() + r.size(), out);
    return true;
  }
};

}  // namespace

CeresResult MinimizeWithCeres(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& residuals,
    const Eigen::VectorXd& x) {
  CeresResult result;
  result.x = x;
  const int unknowns = static_cast<int>(x.size());
  auto* cost = new ceres::DynamicNumericDiffCostFunction<Functor, ceres::RIDDERS>(
      new Functor{&residuals, unknowns});
  cost->AddParameterBlock(unknowns);
  cost->SetNumResiduals(static_cast<int>(residuals(x).size()));
  ceres::Problem problem;
  problem.AddResidualBlock(cost, nullptr, result.x.data());
  ceres::Solver::Options options;
  options.max_num_iterations = 200;
  options.function_tolerance = options.gradient_tolerance = options.parameter_tolerance = 1e-14;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  result.energy = residuals(result.x).squaredNorm();
  result.usable = summary.IsSolutionUsable();
  result.report = summary.BriefReport();
  return result;
}

}  // namespace vitruvia
