// Ways to solve the normal equations of one step.
#pragma once

#include <memory>

#include <Eigen/Core>

namespace vitruvia {

enum class LinearSolverKind {
  kConjugateGradients,                // as they are
  kPreconditionedConjugateGradients,  // with the inverse diagonal
  kDenseCholesky,
  kSparseCholesky,  // with a fill-reducing order; of use when blocks are mostly empty
};
enum class Precision { kDouble, kFloat };

struct LinearSolverOptions {
  LinearSolverKind kind = LinearSolverKind::kDenseCholesky;
  Precision precision = Precision::kDouble;  // of Cholesky's factors; gradients stay in double
  double relative_tolerance = 1e-6;          // conjugate gradients
  int max_iterations = 204;                  // conjugate gradients
};

class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  // Solves A x = b, A symmetric positive definite. False if A is not (to rounding): x is then 0.
  virtual bool Solve(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, Eigen::VectorXd& x) = 0;
  // An estimate of the last A's condition number: a lower bound by Ritz values of the (scaled)
  // matrix from conjugate gradients, LAPACK's 1-norm estimate from Cholesky. -1: not known.
  virtual double EstimateCondition() const = 0;
};

std::unique_ptr<LinearSolver> MakeLinearSolver(const LinearSolverOptions& options);

}  // namespace vitruvia
