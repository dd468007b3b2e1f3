// Solvers for the normal equations of one step.
#pragma once

#include <memory>

#include <Eigen/Core>

namespace vitruvia {

enum class LinearSolverKind {
  kConjugateGradients,                // without preconditioner
  kPreconditionedConjugateGradients,  // Jacobi: the inverse diagonal
  kDenseCholesky,
  kSparseCholesky,  // with a fill-reducing ordering, for matrices whose blocks are mostly empty
};
enum class Precision { kDouble, kFloat };

struct LinearSolverOptions {
  LinearSolverKind kind = LinearSolverKind::kDenseCholesky;
  Precision precision = Precision::kDouble;  // of Cholesky's factors; gradients stay in double
  double relative_tolerance = 1e-6;          // conjugate gradients
  int max_iterations = 204;                  // conjugate gradients
};

enum class SolveStatus {
  kSolved,  // to the tolerance (conjugate gradients) or to rounding (Cholesky)
  // Conjugate gradients reached their iteration limit first: x reduces ½ xᵀA x − bᵀx, but A x = b
  // does not hold to the tolerance.
  kInexact,
  kNotPositiveDefinite,  // to rounding, or not finite: x is 0
};

class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  // Solves A x = b, A symmetric positive definite.
  virtual SolveStatus Solve(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                            Eigen::VectorXd& x) = 0;
  // An estimate of the last A's condition number: from conjugate gradients a lower bound by Ritz
  // values of the (preconditioned) matrix, from dense Cholesky LAPACK's 1-norm estimate, from
  // sparse Cholesky none. -1 where there is none.
  virtual double EstimateCondition() const = 0;
};

std::unique_ptr<LinearSolver> MakeLinearSolver(const LinearSolverOptions& options);

}  // namespace vitruvia
