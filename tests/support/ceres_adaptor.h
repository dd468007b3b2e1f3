// Ceres as an independent minimiser: the reference that our own solvers are held against.
#pragma once

#include <functional>
#include <string>

#include <Eigen/Core>

namespace vitruvia {

struct CeresResult {
  Eigen::VectorXd x;
  double energy = 0.0;  // ‖residuals(x)‖²
  bool usable = false;
  std::string report;
};

// Minimises ‖residuals(x)‖² from x with Levenberg–Marquardt, numeric (Ridders) derivatives and
// tight tolerances. Slow, but independent of our own solvers.
CeresResult MinimizeWithCeres(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& residuals,
    const Eigen::VectorXd& x);

}  // namespace vitruvia
