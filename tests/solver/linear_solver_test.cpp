#include "solver/linear_solver.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "core/random.h"

namespace vitruvia {
namespace {

constexpr int kSolved = 30;
constexpr LinearSolverKind kAll[] = {
    LinearSolverKind::kConjugateGradients, LinearSolverKind::kPreconditionedConjugateGradients,
    LinearSolverKind::kDenseCholesky, LinearSolverKind::kSparseCholesky};

// Symmetric, with eigenvalues from 1 to `condition`.
Eigen::MatrixXd MatrixOfCondition(double condition) {
  RandomStream random(2, "matrix");
  const Eigen::MatrixXd noise = Eigen::MatrixXd::NullaryExpr(
      kSolved, kSolved, [&](Eigen::Index, Eigen::Index) { return random.Normal(); });
  const Eigen::MatrixXd q = noise.householderQr().householderQ();
  Eigen::VectorXd eigenvalues = Eigen::VectorXd::LinSpaced(kSolved, 1.0, condition);
  return q * eigenvalues.asDiagonal() * q.transpose();
}

TEST(LinearSolver, AllKindsSolveToTheirPrecision) {
  const Eigen::MatrixXd a = MatrixOfCondition(50.0);
  const Eigen::VectorXd expected = Eigen::VectorXd::LinSpaced(kSolved, -1.0, 2.0);
  for (const LinearSolverKind kind : kAll) {
    for (const Precision precision : {Precision::kDouble, Precision::kFloat}) {
      const auto solver =
          MakeLinearSolver({.kind = kind, .precision = precision, .relative_tolerance = 1e-12});
      Eigen::VectorXd x;
      ASSERT_EQ(solver->Solve(a, a * expected, x), SolveStatus::kSolved);
      const double tolerance = precision == Precision::kFloat ? 1e-4 : 1e-9;
      EXPECT_LT((x - expected).norm(), tolerance * expected.norm()) << static_cast<int>(kind);
    }
  }
}

TEST(LinearSolver, CholeskyRefusesWhatIsNotPositiveDefinite) {
  Eigen::MatrixXd a = MatrixOfCondition(10.0);
  a(3, 3) = -5.0;
  for (const auto kind : {LinearSolverKind::kDenseCholesky, LinearSolverKind::kSparseCholesky}) {
    Eigen::VectorXd x = Eigen::VectorXd::Ones(kSolved);
    EXPECT_EQ(MakeLinearSolver({.kind = kind})->Solve(a, Eigen::VectorXd::Ones(kSolved), x),
              SolveStatus::kNotPositiveDefinite);
    EXPECT_EQ(x, Eigen::VectorXd::Zero(kSolved));
  }
}

TEST(LinearSolver, ConjugateGradientsSayWhetherTheyReachedTheirTolerance) {
  const Eigen::MatrixXd a = MatrixOfCondition(400.0);
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(kSolved);
  for (const auto kind : {LinearSolverKind::kConjugateGradients,
                          LinearSolverKind::kPreconditionedConjugateGradients}) {
    Eigen::VectorXd x;
    EXPECT_EQ(MakeLinearSolver({.kind = kind, .max_iterations = 100})->Solve(a, b, x),
              SolveStatus::kSolved);
    // Cut short, x is a step on the way: it lowers ½ xᵀA x − bᵀx.
    EXPECT_EQ(MakeLinearSolver({.kind = kind, .max_iterations = 3})->Solve(a, b, x),
              SolveStatus::kInexact);
    EXPECT_LT(0.5 * x.dot(a * x) - b.dot(x), 0.0);
    EXPECT_GT((a * x - b).norm(), 1e-6 * b.norm());
  }
}

TEST(LinearSolver, ConjugateGradientsRefuseWhatIsNotPositiveDefinite) {
  Eigen::MatrixXd a = MatrixOfCondition(10.0);
  a(3, 3) = -5.0;
  for (const auto kind : {LinearSolverKind::kConjugateGradients,
                          LinearSolverKind::kPreconditionedConjugateGradients}) {
    Eigen::VectorXd x = Eigen::VectorXd::Ones(kSolved);
    EXPECT_EQ(MakeLinearSolver({.kind = kind})->Solve(a, Eigen::VectorXd::Ones(kSolved), x),
              SolveStatus::kNotPositiveDefinite);
    EXPECT_EQ(x, Eigen::VectorXd::Zero(kSolved));
  }
}

TEST(LinearSolver, EstimatesTheCondition) {
  const Eigen::MatrixXd a = MatrixOfCondition(400.0);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(kSolved, -1.0, 2.0);
  Eigen::VectorXd x;
  const auto cg = MakeLinearSolver(
      {.kind = LinearSolverKind::kConjugateGradients, .relative_tolerance = 1e-14});
  EXPECT_EQ(cg->EstimateCondition(), -1.0) << "nothing was solved yet";
  cg->Solve(a, b, x);
  EXPECT_NEAR(cg->EstimateCondition(), 400.0, 4.0);
  // In the 1-norm: between the 2-norm's over n and times n.
  const auto cholesky = MakeLinearSolver({.kind = LinearSolverKind::kDenseCholesky});
  EXPECT_EQ(cholesky->EstimateCondition(), -1.0);
  cholesky->Solve(a, b, x);
  EXPECT_GT(cholesky->EstimateCondition(), 400.0);
  EXPECT_LT(cholesky->EstimateCondition(), 400.0 * kSolved);
}

}  // namespace
}  // namespace vitruvia
