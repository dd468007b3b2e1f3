#include "solver/linear_solver.h"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>

#include "solver/conjugate_gradients.h"

namespace vitruvia {
namespace {

class ConjugateGradientsSolver final : public LinearSolver {
 public:
  ConjugateGradientsSolver(const LinearSolverOptions& options, Preconditioner preconditioner)
      : options_(options), solver_(preconditioner) {}

  SolveStatus Solve(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                    Eigen::VectorXd& x) override {
    const ConjugateGradientsSummary summary =
        solver_.Solve(a, b, options_.relative_tolerance, options_.max_iterations, x);
    if (!summary.found_non_positive_curvature && x.allFinite())
      return summary.converged ? SolveStatus::kSolved : SolveStatus::kInexact;
    x.setZero();
    return SolveStatus::kNotPositiveDefinite;
  }
  double EstimateCondition() const override { return solver_.RitzCondition(); }

 private:
  LinearSolverOptions options_;
  ConjugateGradients solver_;
};

template <class Scalar>
class DenseCholeskySolver final : public LinearSolver {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  SolveStatus Solve(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                    Eigen::VectorXd& x) override {
    factors_.compute(a.template cast<Scalar>());
    if (factors_.info() == Eigen::Success) {
      x = factors_.solve(b.template cast<Scalar>().eval()).template cast<double>();
      if (x.allFinite()) return SolveStatus::kSolved;
    }
    x.setZero(b.size());
    return SolveStatus::kNotPositiveDefinite;
  }
  double EstimateCondition() const override {
    if (factors_.rows() == 0 || factors_.info() != Eigen::Success) return -1.0;
    const double reciprocal = factors_.rcond();
    return reciprocal > 0.0 ? 1.0 / reciprocal : -1.0;
  }

 private:
  Eigen::LLT<Matrix> factors_;
};

template <class Scalar>
class SparseCholeskySolver final : public LinearSolver {
 public:
  SolveStatus Solve(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                    Eigen::VectorXd& x) override {
    sparse_ = a.template cast<Scalar>().sparseView();
    factors_.compute(sparse_);
    if (factors_.info() == Eigen::Success) {
      x = factors_.solve(b.template cast<Scalar>().eval()).template cast<double>();
      if (x.allFinite()) return SolveStatus::kSolved;
    }
    x.setZero(b.size());
    return SolveStatus::kNotPositiveDefinite;
  }
  double EstimateCondition() const override { return -1.0; }

 private:
  Eigen::SparseMatrix<Scalar> sparse_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<Scalar>> factors_;
};

template <template <class> class Solver>
std::unique_ptr<LinearSolver> MakeIn(Precision precision) {
  if (precision == Precision::kFloat) return std::make_unique<Solver<float>>();
  return std::make_unique<Solver<double>>();
}

}  // namespace

std::unique_ptr<LinearSolver> MakeLinearSolver(const LinearSolverOptions& options) {
  switch (options.kind) {
    case LinearSolverKind::kConjugateGradients:
      return std::make_unique<ConjugateGradientsSolver>(options, Preconditioner::kNone);
    case LinearSolverKind::kPreconditionedConjugateGradients:
      return std::make_unique<ConjugateGradientsSolver>(options, Preconditioner::kJacobi);
    case LinearSolverKind::kSparseCholesky:
      return MakeIn<SparseCholeskySolver>(options.precision);
    case LinearSolverKind::kDenseCholesky:
      break;
  }
  return MakeIn<DenseCholeskySolver>(options.precision);
}

}  // namespace vitruvia
