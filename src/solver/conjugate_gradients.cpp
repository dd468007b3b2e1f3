#include "solver/conjugate_gradients.h"

#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

namespace vitruvia {

ConjugateGradientsSummary ConjugateGradients::Solve(const Eigen::MatrixXd& a,
                                                    const Eigen::VectorXd& b,
                                                    double relative_tolerance, int max_iterations,
                                                    Eigen::VectorXd& x) {
  ConjugateGradientsSummary summary;
  alphas_.clear();
  betas_.clear();
  inverse_diagonal_ = a.diagonal().unaryExpr([this](double d) {
    if (!(d > 0.0)) return 0.0;
    return preconditioner_ == Preconditioner::kJacobi ? 1.0 / d : 1.0;
  });
  x.setZero(b.size());
  if ((a.diagonal().array() < 0.0).any()) {
    summary.found_non_positive_curvature = true;
    return summary;
  }
  residual_ = b;
  const double b_norm = b.norm();
  if (b_norm == 0.0) {
    summary.converged = true;
    return summary;
  }
  preconditioned_ = inverse_diagonal_.cwiseProduct(residual_);
  direction_ = preconditioned_;
  double rho = residual_.dot(preconditioned_);
  while (summary.iterations < max_iterations) {
    a_direction_.noalias() = a * direction_;
    const double curvature = direction_.dot(a_direction_);
    if (!(curvature > 0.0)) {
      summary.found_non_positive_curvature = true;
      break;
    }
    const double alpha = rho / curvature;
    x += alpha * direction_;
    residual_ -= alpha * a_direction_;
    ++summary.iterations;
    alphas_.push_back(alpha);
    summary.relative_residual = residual_.norm() / b_norm;
    if (summary.relative_residual <= relative_tolerance) {
      summary.converged = true;
      break;
    }
    preconditioned_ = inverse_diagonal_.cwiseProduct(residual_);
    const double next_rho = residual_.dot(preconditioned_);
    betas_.push_back(next_rho / rho);
    direction_ = preconditioned_ + betas_.back() * direction_;
    rho = next_rho;
  }
  return summary;
}

// The coefficients of conjugate gradients form the tridiagonal matrix of the Lanczos process; its
// eigenvalues (Ritz values) approach the extreme ones of the preconditioned matrix (Saad 2003,
// 6.7.3).
double ConjugateGradients::RitzCondition() const {
  const auto n = static_cast<Eigen::Index>(alphas_.size());
  if (n == 0) return -1.0;
  Eigen::VectorXd diagonal(n), off_diagonal(std::max<Eigen::Index>(n - 1, 1));
  for (Eigen::Index i = 0; i < n; ++i) {
    diagonal[i] = 1.0 / alphas_[i] + (i > 0 ? betas_[i - 1] / alphas_[i - 1] : 0.0);
    if (i + 1 < n) off_diagonal[i] = std::sqrt(betas_[i]) / alphas_[i];
  }
  if (n == 1) return 1.0;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, off_diagonal, Eigen::EigenvaluesOnly);
  const double smallest = solver.eigenvalues()[0];
  if (!(smallest > 0.0)) return std::numeric_limits<double>::infinity();
  return solver.eigenvalues()[n - 1] / smallest;
}

}  // namespace vitruvia
