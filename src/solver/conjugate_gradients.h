// Conjugate gradients for small dense symmetric positive (semi)definite systems.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace vitruvia {

struct ConjugateGradientsSummary {
  int iterations = 0;
  bool converged = false;  // relative residual below the tolerance
  // The curvature along a search direction was zero, negative or NaN: the matrix is not positive
  // definite.
  bool found_non_positive_curvature = false;
  double relative_residual = 0;  // ‖b − A x‖ / ‖b‖ of the recursively updated residual
};

enum class Preconditioner { kNone, kJacobi };

// Solves A x = b from x = 0 until the residual has fallen by `relative_tolerance`, after
// max_iterations, or at a direction of non-positive curvature; x is the last iterate. Unknowns
// whose diagonal entry in A is 0 stay 0.
class ConjugateGradients {
 public:
  explicit ConjugateGradients(Preconditioner preconditioner = Preconditioner::kJacobi)
      : preconditioner_(preconditioner) {}

  ConjugateGradientsSummary Solve(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                  double relative_tolerance, int max_iterations,
                                  Eigen::VectorXd& x);

  // Ratio of the extreme Ritz values of the last, preconditioned matrix: a lower bound of its
  // condition number that tightens as the iterations span the space. −1 with no iteration.
  double RitzCondition() const;

 private:
  Preconditioner preconditioner_;
  Eigen::VectorXd inverse_diagonal_, residual_, preconditioned_, direction_, a_direction_;
  std::vector<double> alphas_, betas_;
};

}  // namespace vitruvia
