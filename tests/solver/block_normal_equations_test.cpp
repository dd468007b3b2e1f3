#include "solver/block_normal_equations.h"

#include <array>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "core/random.h"
#include "solver/conjugate_gradients.h"
#include "solver/lane_rows.h"
#include "support/ceres_adaptor.h"

namespace vitruvia {
namespace {

constexpr int kBlocks = 3;
constexpr int kUnknowns = kBlocks * kBlockSize;

// A random problem, as block rows and as one dense matrix.
struct Problem {
  BlockNormalEquations equations{kBlocks};
  Eigen::MatrixXd jacobian;
  Eigen::VectorXd residual, weight;

  explicit Problem(int rows)
      : jacobian(Eigen::MatrixXd::Zero(rows, kUnknowns)), residual(rows), weight(rows) {
    RandomStream random(7, "normal equations");
    for (int i = 0; i < rows; ++i) {
      const int first = static_cast<int>(random.Index(kBlocks));
      const int second = (first + 1) % kBlocks;
      std::vector<BlockNormalEquations::Entry> entries;
      for (const int block : {second, first}) {  // not in ascending order, as bones come
        Vector6d j;
        for (int k = 0; k < kBlockSize; ++k) j[k] = random.Normal();
        entries.push_back({block, j});
        jacobian.block<1, kBlockSize>(i, block * kBlockSize) = j.transpose();
      }
      residual[i] = random.Normal();
      weight[i] = random.Uniform(0.1, 3.0);
      equations.AddRow(entries, residual[i], weight[i]);
    }
    equations.Symmetrize();
  }
};

TEST(BlockNormalEquations, AreTheProductsOfTheDenseJacobian) {
  const Problem p(60);
  const Eigen::MatrixXd weighted = p.weight.asDiagonal() * p.jacobian;
  EXPECT_TRUE(p.equations.hessian().isApprox(p.jacobian.transpose() * weighted, 1e-12));
  EXPECT_TRUE(p.equations.gradient().isApprox(weighted.transpose() * p.residual, 1e-12));
  EXPECT_NEAR(p.equations.energy(), p.residual.dot(p.weight.cwiseProduct(p.residual)), 1e-12);
}

// Rows of two blocks, eight at a time, against one after the other.
TEST(LaneRows, AddUpToWhatSingleRowsDo) {
  constexpr std::array kOf = {2, 0};  // not in ascending order
  BlockNormalEquations single(kBlocks), lanes(kBlocks);
  LaneRows<2, double> rows;
  RandomStream random(3, "lane rows");
  for (int group = 0; group < 5; ++group) {
    LaneRows<2, double>::Row jacobian, weighted;
    DoubleLanes residual, weight;
    for (int lane = 0; lane < kLanes; ++lane) {
      residual[lane] = random.Normal();
      weight[lane] = random.Uniform();
      std::array<BlockNormalEquations::Entry, 2> entries;
      for (int i = 0; i < 2 * kBlockSize; ++i) {
        entries[i / kBlockSize].block = kOf[i / kBlockSize];
        jacobian[i][lane] = entries[i / kBlockSize].jacobian[i % kBlockSize] = random.Normal();
        weighted[i][lane] = weight[lane] * jacobian[i][lane];
      }
      single.AddRow(entries, residual[lane], weight[lane]);
    }
    rows.Add(jacobian, residual, weighted, weight * residual);
  }
  lanes.AddRows(kOf, rows.Sums());
  single.Symmetrize();
  lanes.Symmetrize();
  EXPECT_TRUE(lanes.hessian().isApprox(single.hessian(), 1e-13));
  EXPECT_TRUE(lanes.gradient().isApprox(single.gradient(), 1e-13));
  EXPECT_NEAR(lanes.energy(), single.energy(), 1e-13 * single.energy());
}

TEST(BlockNormalEquations, ResetForgetsAndDampingIsOnTheDiagonal) {
  Problem p(10);
  p.equations.Reset();
  EXPECT_EQ(p.equations.hessian().norm(), 0.0);
  EXPECT_EQ(p.equations.gradient().norm(), 0.0);
  EXPECT_EQ(p.equations.energy(), 0.0);
  p.equations.AddDamping(2.0);
  EXPECT_EQ(p.equations.hessian(),
            Eigen::MatrixXd(2.0 * Eigen::MatrixXd::Identity(kUnknowns, kUnknowns)));
}

TEST(ConjugateGradients, SolveWhatCholeskySolves) {
  const Problem p(60);
  Eigen::VectorXd x;
  const auto summary =
      ConjugateGradients().Solve(p.equations.hessian(), -p.equations.gradient(), 1e-12, 200, x);
  EXPECT_TRUE(summary.converged);
  const Eigen::VectorXd reference = p.equations.hessian().llt().solve(-p.equations.gradient());
  EXPECT_TRUE(x.isApprox(reference, 1e-9));
}

TEST(ConjugateGradients, EstimateTheConditionOfThePreconditionedMatrix) {
  const Problem p(60);
  Eigen::VectorXd x;
  ConjugateGradients solver;
  solver.Solve(p.equations.hessian(), -p.equations.gradient(), 1e-14, 200, x);
  const double condition = solver.RitzCondition();
  const Eigen::VectorXd scale = p.equations.hessian().diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd preconditioned =
      scale.asDiagonal() * p.equations.hessian() * scale.asDiagonal();
  const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(preconditioned).eigenvalues();
  EXPECT_NEAR(condition, eigenvalues[kUnknowns - 1] / eigenvalues[0], 0.01 * condition);
}

TEST(ConjugateGradients, LeaveUnobservedUnknownsAtZero) {
  BlockNormalEquations equations(2);
  Vector6d j = Vector6d::Zero();
  j[0] = 2.0;
  equations.AddRow(std::vector<BlockNormalEquations::Entry>{{0, j}}, 3.0, 1.0);
  equations.Symmetrize();
  Eigen::VectorXd x;
  const auto summary =
      ConjugateGradients().Solve(equations.hessian(), -equations.gradient(), 1e-10, 50, x);
  EXPECT_TRUE(summary.converged);
  EXPECT_DOUBLE_EQ(x[0], -1.5);
  EXPECT_EQ(x.tail(11).norm(), 0.0);
}

TEST(ConjugateGradients, AreDoneAtOnceWithNothingToDo) {
  Eigen::VectorXd x;
  const auto summary = ConjugateGradients().Solve(Eigen::MatrixXd::Identity(6, 6),
                                                  Eigen::VectorXd::Zero(6), 1e-6, 10, x);
  EXPECT_TRUE(summary.converged);
  EXPECT_EQ(summary.iterations, 0);
  EXPECT_EQ(x, Eigen::VectorXd::Zero(6));
}

TEST(MinimizeWithCeres, FindsTheLeastSquaresSolution) {
  const Problem p(60);
  const auto residuals = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return p.weight.cwiseSqrt().cwiseProduct(p.jacobian * x + p.residual);
  };
  const CeresResult result = MinimizeWithCeres(residuals, Eigen::VectorXd::Zero(kUnknowns));
  ASSERT_TRUE(result.usable) << result.report;
  const Eigen::VectorXd reference = p.equations.hessian().llt().solve(-p.equations.gradient());
  EXPECT_NEAR(result.energy, residuals(reference).squaredNorm(), 1e-9 * result.energy);
}

}  // namespace
}  // namespace vitruvia
