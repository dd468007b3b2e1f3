// The parts of an alternation against slow, direct computations.
#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "learning/skinning/joint_step.h"
#include "learning/skinning/transform_step.h"
#include "learning_skinning/planted.h"
#include "math/rigid.h"
#include "math/rotation.h"

namespace vitruvia::skinning {
namespace {

BoneStack ToStack(const std::vector<BoneTransforms>& poses) {
  BoneStack stack(4 * poses.front().size(), 3 * poses.size());
  for (std::size_t p = 0; p < poses.size(); ++p) {
    for (std::size_t b = 0; b < poses[p].size(); ++b) {
      stack.block<3, 3>(4 * b, 3 * p) = poses[p][b].rotation.transpose();
      stack.block<1, 3>(4 * b + 3, 3 * p) = poses[p][b].translation.transpose();
    }
  }
  return stack;
}

// A planted problem with transforms and weights somewhat off, in the order of packed rows.
struct Bench {
  mutable WorkerTeam team{1};
  Planted planted;
  PackedExamples packed;
  BoneStack stack;
  RowWeights weights;

  explicit Bench(const PlantedShape& shape, double error_rad = 0.05)
      : planted(Plant(shape)), packed(planted.examples, planted.labels) {
    RandomStream random(shape.seed, "errors");
    std::vector<BoneTransforms> bones = planted.bones;
    for (std::size_t p = 0; p < bones.size(); ++p) {
      for (Rigidd& bone : bones[p]) {
        const Vector3d turn =
            Vector3d::NullaryExpr([&](Eigen::Index) { return random.Normal(0.0, error_rad); });
        const Vector3d centre = bone * packed.rest_centroid();
        bone = RotationAbout<double>(ExpSo3<double>(turn), centre) * bone;
        bone.translation +=
            bone.rotation * packed.rest_centroid() - packed.PoseCentroid(static_cast<int>(p));
      }
    }
    stack = ToStack(bones);
    weights = planted.weights;
    for (int row = 0; row < packed.vertex_count(); ++row) {
      weights.bones[row] = planted.weights.bones[packed.VertexOfRow(row)];
      weights.weights[row] = planted.weights.weights[packed.VertexOfRow(row)];
    }
  }

  std::vector<std::uint8_t> RowLabels() const {
    std::vector<std::uint8_t> labels;
    for (int row = 0; row < packed.vertex_count(); ++row) {
      labels.push_back(planted.labels[packed.VertexOfRow(row)]);
    }
    return labels;
  }
  Eigen::VectorXd U(int row) const {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(stack.rows());
    for (int k = 0; k < kMaxInfluences; ++k) {
      u.segment<4>(4 * weights.bones[row][k]) +=
          static_cast<double>(weights.weights[row][k]) * packed.Rest(row).cast<double>();
    }
    return u;
  }
  Eigen::VectorXd Residual(int row, const BoneStack& at) const {
    const Eigen::Map<const Eigen::VectorXf> observed(packed.Row(row), at.cols());
    return observed.cast<double>() - at.transpose() * U(row);
  }
  double Energy(const BoneStack& at) const {
    double energy = 0.0;
    for (int row = 0; row < packed.vertex_count(); ++row) {
      energy += Residual(row, at).squaredNorm();
    }
    return energy;
  }
  SkinMoments Moments(WeightStep& step) const {
    SkinMoments moments(BoneCount(stack), PoseCount(stack));
    step.Gather(stack, weights, moments);
    return moments;
  }
  WeightStep MakeWeightStep() const {
    return {packed, RowLabels(), planted.candidates, kMaxInfluences, team};
  }
};

const PlantedShape kSmall = {.vertices = 60, .bones = 3, .poses = 4};

TEST(WeightStep, GathersTheMoments) {
  const Bench bench(kSmall);
  WeightStep step = bench.MakeWeightStep();
  const SkinMoments moments = bench.Moments(step);
  SkinMoments slow(3, 4);
  for (int row = 0; row < bench.packed.vertex_count(); ++row) {
    const Eigen::VectorXd u = bench.U(row), e = bench.Residual(row, bench.stack);
    slow.second += u * u.transpose();
    slow.cross += u * e.transpose();
    slow.energy += e.squaredNorm();
  }
  EXPECT_LT((moments.second - slow.second).norm(), 1e-6 * slow.second.norm());
  EXPECT_LT((moments.cross - slow.cross).norm(), 1e-5 * slow.cross.norm());
  EXPECT_NEAR(moments.energy, slow.energy, 1e-5 * slow.energy);
}

TEST(WeightStep, MomentsTellTheEnergyOfAnyOtherTransforms) {
  const Bench bench(kSmall);
  WeightStep step = bench.MakeWeightStep();
  const SkinMoments moments = bench.Moments(step);
  const BoneStack change = 0.01 * BoneStack::Random(bench.stack.rows(), bench.stack.cols());
  const double predicted = moments.energy - 2.0 * moments.cross.cwiseProduct(change).sum() +
                           change.cwiseProduct(moments.second * change).sum();
  const double slow = bench.Energy(bench.stack + change);
  EXPECT_NEAR(predicted, slow, 1e-5 * slow);
}

TEST(WeightStep, FindsThePlantedWeightsAtThePlantedTransforms) {
  Bench bench({.vertices = 200, .bones = 4, .poses = 10}, 0.0);
  const RowWeights truth = bench.weights;
  WeightStep step = bench.MakeWeightStep();
  bench.weights.bones.clear();
  for (const std::uint8_t label : bench.RowLabels())
    bench.weights.bones.push_back({label, 0, 0, 0});
  bench.weights.weights.assign(200, {1.0f, 0.0f, 0.0f, 0.0f});
  SkinMoments moments(4, 10);
  step.Solve(bench.stack, bench.weights, moments);
  EXPECT_LT((Dense(bench.weights, 4) - Dense(truth, 4)).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_EQ(WeightsProblem(bench.weights, 200, 4), "");
}

TEST(PoseEquations, DifferentialIsTheDerivativeOfMove) {
  const Bench bench(kSmall);
  const PoseBlock pose = bench.stack.middleCols<3>(3);
  const Eigen::VectorXd step = Eigen::VectorXd::Random(18);
  constexpr double kStep = 1e-5;
  PoseBlock ahead(12, 3), behind(12, 3), change(12, 3);
  Move(pose, kStep * step, ahead);
  Move(pose, -kStep * step, behind);
  Differential(pose, step, change);
  EXPECT_LT(((ahead - behind) / (2.0 * kStep) - change).norm(), 1e-9);
}

TEST(PoseEquations, AdjointBelongsToDifferential) {
  const Bench bench(kSmall);
  const PoseBlock pose = bench.stack.middleCols<3>(6);
  const PoseBlock pull = PoseBlock::Random(12, 3);
  const Eigen::VectorXd step = Eigen::VectorXd::Random(18);
  PoseBlock change(12, 3);
  Eigen::VectorXd adjoint(18);
  Differential(pose, step, change);
  Adjoint(pose, pull, adjoint);
  EXPECT_NEAR(change.cwiseProduct(pull).sum(), step.dot(adjoint), 1e-12);
}

// The Jacobian of all places of one pose by the step, by central differences.
Eigen::MatrixXd NumericJacobian(const Bench& bench, const PoseBlock& at) {
  constexpr double kStep = 1e-5;
  const auto steps = 6 * bench.stack.rows() / 4;
  Eigen::MatrixXd jacobian(3 * bench.packed.vertex_count(), steps);
  for (Eigen::Index s = 0; s < steps; ++s) {
    PoseBlock ahead = at, behind = at;
    Move(at, kStep * Eigen::VectorXd::Unit(steps, s), ahead);
    Move(at, -kStep * Eigen::VectorXd::Unit(steps, s), behind);
    for (int row = 0; row < bench.packed.vertex_count(); ++row) {
      jacobian.block<3, 1>(3 * row, s) =
          (ahead - behind).transpose() * bench.U(row) / (2.0 * kStep);
    }
  }
  return jacobian;
}

TEST(PoseEquations, SolveTheNormalEquationsOfFiniteDifferences) {
  const Bench bench(kSmall);
  WeightStep weight_step = bench.MakeWeightStep();
  const SkinMoments moments = bench.Moments(weight_step);
  const PoseBlock pose = bench.stack.middleCols<3>(3);
  const Eigen::MatrixXd jacobian = NumericJacobian(bench, pose);
  Eigen::VectorXd residual(3 * bench.packed.vertex_count());
  for (int row = 0; row < bench.packed.vertex_count(); ++row) {
    residual.segment<3>(3 * row) = bench.Residual(row, bench.stack).segment<3>(3);
  }
  BonePattern pattern(3);
  pattern.Analyse(moments.second);
  PoseEquations equations;
  equations.Linearise(pattern, moments.second, pose);
  ASSERT_TRUE(equations.Factor(pattern, 0.0));
  Eigen::VectorXd step(18);
  Adjoint(pose, moments.cross.middleCols<3>(3), step);
  EXPECT_LT((step - jacobian.transpose() * residual).norm(), 1e-5 * step.norm());
  equations.SolveInPlace(pattern, step);
  const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  const Eigen::VectorXd slow = normal.ldlt().solve(jacobian.transpose() * residual);
  EXPECT_LT((step - slow).norm(), 1e-4 * slow.norm());
}

TEST(BoneCholesky, SolvesWhatADenseDecompositionSolves) {
  constexpr int kBones = 7;
  // A tree with a loop: 0-1, 1-2, 1-3, 3-4, 4-5, 5-6, 6-3.
  Eigen::MatrixXd second = Eigen::MatrixXd::Zero(4 * kBones, 4 * kBones);
  const std::pair<int, int> coupled[] = {{0, 1}, {1, 2}, {1, 3}, {3, 4}, {4, 5}, {5, 6}, {6, 3}};
  for (const auto& [a, b] : coupled) {
    second(4 * a + 3, 4 * b + 3) = second(4 * b + 3, 4 * a + 3) = 1.0;
  }
  BonePattern pattern(kBones);
  pattern.Analyse(second);
  EXPECT_EQ(pattern.blocks(), 7 + 7 + 1);  // the loop of four fills one
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(6 * kBones, 6 * kBones);
  std::vector<Matrix6> blocks(pattern.blocks(), Matrix6::Zero());
  for (int row = 0; row < kBones; ++row) {
    for (int column = 0; column <= row; ++column) {
      const int a = pattern.BoneAt(row), b = pattern.BoneAt(column);
      if (a != b && second(4 * a + 3, 4 * b + 3) == 0.0) continue;
      Matrix6 block = Matrix6::Random();
      if (a == b) block = (block * block.transpose() + 20.0 * Matrix6::Identity()).eval();
      blocks[pattern.Slot(row, column)] = block;
      dense.block<6, 6>(6 * a, 6 * b) = block;
      dense.block<6, 6>(6 * b, 6 * a) = block.transpose();
    }
  }
  BoneCholesky cholesky;
  ASSERT_TRUE(cholesky.Factor(pattern, blocks));
  const Eigen::VectorXd right = Eigen::VectorXd::Random(6 * kBones);
  Eigen::VectorXd x = right;
  cholesky.SolveInPlace(pattern, x);
  EXPECT_LT((dense * x - right).norm(), 1e-10);
  blocks[pattern.Slot(2, 2)].setZero();
  EXPECT_FALSE(cholesky.Factor(pattern, blocks));
}

class TransformSolvers : public testing::TestWithParam<TransformSolver> {};

TEST_P(TransformSolvers, ReachTheSameLeastEnergyAndSayIt) {
  Bench bench({.vertices = 100, .bones = 3, .poses = 5, .noise_m = 0.002});
  WeightStep weight_step = bench.MakeWeightStep();
  const SkinMoments moments = bench.Moments(weight_step);
  BonePattern pattern(3);
  pattern.Analyse(moments.second);
  BoneStack stack = bench.stack;
  const double energy =
      TransformStep(3, 5, GetParam(), 100, bench.team).Solve(pattern, moments, stack);
  EXPECT_NEAR(energy, bench.Energy(stack), 1e-4 * energy);
  BoneStack reference = bench.stack;
  const double least = TransformStep(3, 5, TransformSolver::kLinearised, 20, bench.team)
                           .Solve(pattern, moments, reference);
  EXPECT_NEAR(energy, least, 1e-4 * least);
  for (int b = 0; b < 3; ++b) {
    const Matrix3<double> rotation = stack.block<3, 3>(4 * b, 0);
    EXPECT_LT((rotation * rotation.transpose() - Matrix3<double>::Identity()).norm(), 1e-12);
    EXPECT_GT(rotation.determinant(), 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Both, TransformSolvers,
                         testing::Values(TransformSolver::kClosedForm,
                                         TransformSolver::kLinearised));

// The step from a dense normal matrix over all poses in which each vertex's residual change is
// freed of what its weights can undo.
TEST(JointStep, SolvesTheProjectedNormalEquations) {
  Bench bench({.vertices = 60, .bones = 3, .poses = 4}, 0.01);
  constexpr int kPoses = 4, kSteps = 18;
  constexpr double kDamping = 1e-3;
  WeightStep weight_step = bench.MakeWeightStep();
  SkinMoments moments(3, kPoses);
  weight_step.Solve(bench.stack, bench.weights, moments);
  const int vertices = bench.packed.vertex_count();
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(kPoses * kSteps, kPoses * kSteps);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(kPoses * kSteps), diagonal = right;
  std::vector<Eigen::MatrixXd> jacobians;
  for (int p = 0; p < kPoses; ++p) {
    jacobians.push_back(NumericJacobian(bench, bench.stack.middleCols<3>(3 * p)));
  }
  for (int row = 0; row < vertices; ++row) {
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(3 * kPoses, kPoses * kSteps);
    for (int p = 0; p < kPoses; ++p) {
      jacobian.block(3 * p, kSteps * p, 3, kSteps) = jacobians[p].middleRows(3 * row, 3);
    }
    diagonal += jacobian.colwise().squaredNorm().transpose();
    right += jacobian.transpose() * bench.Residual(row, bench.stack);
    int free = 0;
    Eigen::MatrixXd effects(3 * kPoses, kMaxInfluences - 1);
    const auto place = [&](int k) -> Eigen::VectorXd {
      return bench.stack.middleRows<4>(4 * bench.weights.bones[row][k]).transpose() *
             bench.packed.Rest(row).cast<double>();
    };
    for (int k = 1; k < kMaxInfluences && bench.weights.weights[row][k] > 0.0f; ++k) {
      effects.col(free++) = place(k) - place(0);
    }
    if (free > 0) {
      const Eigen::MatrixXd a = effects.leftCols(free);
      jacobian -= a * (a.transpose() * a).ldlt().solve(a.transpose() * jacobian);
    }
    normal += jacobian.transpose() * jacobian;
  }
  normal.diagonal() += kDamping * diagonal;
  const Eigen::VectorXd step = normal.ldlt().solve(right);

  BonePattern pattern(3);
  pattern.Analyse(moments.second);
  BoneStack next(12, 3 * kPoses);
  JointStep(bench.packed, 3, 500, bench.team)
      .Solve(pattern, moments, bench.weights, bench.stack, kDamping, next);
  for (int p = 0; p < kPoses; ++p) {
    PoseBlock expected(12, 3);
    Move(bench.stack.middleCols<3>(3 * p), step.segment(kSteps * p, kSteps), expected);
    const double size = (expected - bench.stack.middleCols<3>(3 * p)).norm();
    EXPECT_LT((next.middleCols<3>(3 * p) - expected).norm(), 0.01 * size) << p;
  }
}

}  // namespace
}  // namespace vitruvia::skinning
