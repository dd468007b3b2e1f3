// The tracker's steps on frozen correspondences against Ceres, which minimises the same energy
// written out independently and in double; and what single precision costs.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "core/error.h"
#include "math/rigid.h"
#include "methods/posed_tiny_body.h"
#include "methods/realtime_scape/pose_step.h"
#include "methods/realtime_scape/terms/axis_term.h"
#include "methods/realtime_scape/terms/fit_term.h"
#include "methods/realtime_scape/terms/inertia_term.h"
#include "methods/realtime_scape/terms/joint_term.h"
#include "solver/linear_solver.h"
#include "support/ceres_adaptor.h"

namespace vitruvia::realtime_scape {
namespace {

constexpr double kJointWeight = 10.0, kInertiaWeight = 5.0, kAxisWeight = 1.0;
constexpr double kWithin = 1e-6;  // of Ceres' optimum

// What one frame's energy is made of while its correspondences stay.
struct Frozen {
  FitData data;
  FitSettings fit;
  JointRows rows = JointRows::kJointPosition;
  std::vector<Vector3d> normals{};  // of plane rows: one for each pair
};

struct Solution {
  BodyPose pose;
  double energy = 0.0;          // as the tracker adds it up
  double rotation_drift = 0.0;  // largest ‖RᵀR − I‖
};

// Squared norms of what is added are the energy.
class ResidualList {
 public:
  void Add(const Vector3d& v, double weight) {
    for (int k = 0; k < 3; ++k) Add(v[k], weight);
  }
  void Add(double value, double weight) { values_.push_back(std::sqrt(weight) * value); }
  Eigen::VectorXd Vector() const {
    return Eigen::Map<const Eigen::VectorXd>(values_.data(),
                                             static_cast<Eigen::Index>(values_.size()));
  }

 private:
  std::vector<double> values_;
};

// What Huber's loss leaves of a residual: its square is the loss.
Vector3d HuberResidual(const Vector3d& v, double scale) {
  const double size = v.norm();
  if (size <= scale) return v;
  return std::sqrt(2.0 * scale * size - scale * scale) / size * v;
}

class Reference : public testing::Test, protected PosedTinyBody {
 protected:
  double Assemble(const Frozen& frozen, const JointTerm& joints, const BodyPose& pose,
                  BlockNormalEquations& equations) const {
    equations.Reset();
    AddFitTerm(model, pose, camera, frozen.data.classes, frozen.data.pairs, frozen.fit, kUnit_m,
               equations);
    joints.Add(model, pose, kJointWeight, kUnit_m, equations);
    AddInertiaTerm(pose, previous, kInertiaWeight, equations);
    AddAxisTerm(pose, kAxisWeight, equations);
    equations.Symmetrize();
    return equations.energy();
  }

  // The tracker's steps: linearise, solve, turn.
  Solution Ours(const Frozen& frozen, const LinearSolverOptions& options, int steps) const {
    const JointTerm joints(model, frozen.rows);
    const std::unique_ptr<LinearSolver> solver = MakeLinearSolver(options);
    BlockNormalEquations equations(kBoneCount);
    Solution solution{rest};
    Eigen::VectorXd x;
    for (int i = 0; i < steps; ++i) {
      Assemble(frozen, joints, solution.pose, equations);
      EXPECT_EQ(solver->Solve(equations.hessian(), -equations.gradient(), x), SolveStatus::kSolved);
      solution.pose = ApplyIncrement(solution.pose, x, kUnit_m, RotationUpdate::kExponential).pose;
    }
    solution.energy = Assemble(frozen, joints, solution.pose, equations);
    for (const BonePose& bone : solution.pose) {
      const Matrix3<double> product = bone.rotation.transpose() * bone.rotation;
      solution.rotation_drift =
          std::max(solution.rotation_drift, (product - Matrix3<double>::Identity()).norm());
    }
    return solution;
  }

  void AddFit(const Frozen& frozen, const BoneTransforms& t, ResidualList& r) const {
    for (std::size_t k = 0; k < frozen.data.pairs.size(); ++k) {
      const Pair& pair = frozen.data.pairs[k];
      const Vector3d offset = PosedVertex(model, t, pair.vertex) - pair.target.cast<double>();
      if (!frozen.normals.empty()) {
        r.Add(frozen.normals[k].dot(offset) / kUnit_m, 1.0);
      } else if (frozen.fit.kernel == RobustKernel::kHuber) {
        r.Add(HuberResidual(offset, frozen.fit.kernel_scale_m) / kUnit_m, 1.0);
      } else {
        r.Add(offset / kUnit_m, 1.0);
      }
    }
    const VertexClasses& classes = frozen.data.classes;
    for (std::size_t k = 0; k < classes.near_surface.size(); ++k) {
      const Vector3d vertex = PosedVertex(model, t, classes.near_surface[k]);
      r.Add((vertex.z() - double{classes.observed_depth[k]}) / kUnit_m, 1.0);
    }
  }

  // eq. 7's sum over the vertices that both bones move, as far as the reading takes it.
  void AddJoint(JointRows rows, int bone, const BoneTransforms& t, ResidualList& r) const {
    const int parent = Bones()[bone].parent;
    const auto gap = [&](const Vector3d& rest_point) -> Vector3d {
      return (t[bone] * rest_point - t[parent] * rest_point) / kUnit_m;
    };
    if (rows == JointRows::kJointPosition) {
      return r.Add(gap(body.skeleton.joints[bone]), kJointWeight);
    }
    const Eigen::MatrixXd weights = Dense(body.weights, kBoneCount).cast<double>();
    const Eigen::VectorXd shared = weights.col(bone).cwiseProduct(weights.col(parent));
    Vector3d mean = Vector3d::Zero();
    for (int i = 0; i < VertexCount(); ++i) {
      if (shared[i] == 0.0) continue;
      const Vector3d rest_point = model.rest_vertices[i].cast<double>();
      const double share = shared[i] / shared.sum();
      mean += share * rest_point;
      if (rows == JointRows::kAllVertices) r.Add(gap(rest_point), kJointWeight * share);
    }
    if (rows == JointRows::kMeanPoint) r.Add(gap(mean), kJointWeight);
  }

  Eigen::VectorXd Residuals(const Frozen& frozen, const BodyPose& pose) const {
    const BoneTransforms t = ToTransforms(model, pose);
    ResidualList r;
    AddFit(frozen, t, r);
    for (int j = 0; j < kBoneCount; ++j) {
      const int parent = Bones()[j].parent;
      const Matrix3<double> predicted =
          parent < 0 ? previous[j] : pose[parent].rotation * previous[j];
      for (int c = 0; c < 3; ++c) {
        r.Add(pose[j].rotation.col(c) - predicted.col(c), kInertiaWeight);
      }
      if (parent >= 0) AddJoint(frozen.rows, j, t, r);
    }
    const auto hinge = [&](BoneId id, const Vector3d& d) {
      const int j = static_cast<int>(id);
      r.Add(pose[j].rotation * d - pose[Bones()[j].parent].rotation * d, kAxisWeight);
    };
    for (const BoneId id : {BoneId::kHead, BoneId::kLeftForearm, BoneId::kRightForearm})
      hinge(id, Vector3d::UnitY());
    for (const BoneId id :
         {BoneId::kLeftShin, BoneId::kRightShin, BoneId::kLeftFoot, BoneId::kRightFoot}) {
      hinge(id, Vector3d::UnitX());
    }
    return r.Vector();
  }

  // Ceres' optimum, looked for from `start`.
  double OptimumFrom(const Frozen& frozen, const BodyPose& start) const {
    const CeresResult result = MinimizeWithCeres(
        [&](const Eigen::VectorXd& x) { return Residuals(frozen, Moved(start, x)); },
        Eigen::VectorXd::Zero(kUnknowns));
    EXPECT_TRUE(result.usable) << result.report;
    return result.energy;
  }

  // V1 as depths and pairs beside them, both some centimetres off.
  Frozen DepthsAndPairs() const {
    Frozen frozen{Pairs(bent, 7, 0.02), {}};
    frozen.data.classes = Depths(bent, 5, 0.02).classes;
    frozen.fit.surface_residual = SurfaceResidual::kDepth;
    frozen.fit.kernel = RobustKernel::kNone;
    return frozen;
  }
};

constexpr int kSteps = 40;

TEST_F(Reference, EverySolverReachesTheOptimumThatCeresFinds) {
  const Frozen frozen = DepthsAndPairs();
  const double optimum = OptimumFrom(frozen, rest);
  const double start = Residuals(frozen, rest).squaredNorm();
  ASSERT_LT(optimum, 0.9 * start);
  for (const LinearSolverKind kind :
       {LinearSolverKind::kConjugateGradients, LinearSolverKind::kPreconditionedConjugateGradients,
        LinearSolverKind::kDenseCholesky, LinearSolverKind::kSparseCholesky}) {
    const Solution ours = Ours(frozen, {.kind = kind}, kSteps);
    EXPECT_NEAR(ours.energy, optimum, kWithin * optimum) << static_cast<int>(kind);
    // Two independent ways of writing one energy.
    EXPECT_NEAR(ours.energy, Residuals(frozen, ours.pose).squaredNorm(), 1e-9 * ours.energy);
  }
}

TEST_F(Reference, EveryReadingOfTheJointTermReachesTheOptimumThatCeresFinds) {
  for (const JointRows rows : {JointRows::kMeanPoint, JointRows::kAllVertices}) {
    Frozen frozen = DepthsAndPairs();
    frozen.rows = rows;
    const double optimum = OptimumFrom(frozen, rest);
    EXPECT_NEAR(Ours(frozen, {}, kSteps).energy, optimum, kWithin * optimum);
  }
}

// Its weights change with every step; where they settle, Huber's loss is at its smallest.
TEST_F(Reference, ReweightedStepsReachTheOptimumOfHubersLoss) {
  Frozen frozen{Pairs(bent, 7, 0.02), {}};
  frozen.fit.kernel = RobustKernel::kHuber;
  const Solution ours = Ours(frozen, {}, 10 * kSteps);
  const double loss = Residuals(frozen, ours.pose).squaredNorm();
  const double optimum = OptimumFrom(frozen, rest);
  EXPECT_NEAR(loss, optimum, kWithin * optimum);
}

// Normals turn with the model from step to step. With those of the last, Ceres finds nothing lower.
TEST_F(Reference, PlaneRowsEndWhereCeresFindsNothingLower) {
  Frozen frozen{Pairs(bent, 7, 0.02), {}};
  frozen.fit.kernel = RobustKernel::kNone;
  frozen.fit.pair_residual = PairResidual::kPlane;
  const Solution ours = Ours(frozen, {}, 10 * kSteps);
  for (const Pair& pair : frozen.data.pairs) {
    Vector3d normal = Vector3d::Zero();
    for (const auto& [bone, w] : model.InfluencesOf(pair.vertex)) {
      normal +=
          double{w} * (ours.pose[bone].rotation * model.rest_normals[pair.vertex].cast<double>());
    }
    frozen.normals.push_back(normal.normalized());
  }
  EXPECT_NEAR(Residuals(frozen, ours.pose).squaredNorm(), ours.energy, 1e-9 * ours.energy);
  EXPECT_NEAR(OptimumFrom(frozen, ours.pose), ours.energy, kWithin * ours.energy);
}

// Only Cholesky's factors are in single precision; gradients are not, so that a step that is a
// little off is put right by the next.
TEST_F(Reference, SinglePrecisionCostsNothingThatLasts) {
  const Frozen frozen = DepthsAndPairs();
  for (const LinearSolverKind kind :
       {LinearSolverKind::kDenseCholesky, LinearSolverKind::kSparseCholesky}) {
    const LinearSolverOptions in_double{.kind = kind},
        in_float{.kind = kind, .precision = Precision::kFloat};
    const double one_step = Ours(frozen, in_double, 1).energy;
    EXPECT_NEAR(Ours(frozen, in_float, 1).energy, one_step, 1e-7 * one_step);
    const Solution converged = Ours(frozen, in_double, kSteps);
    const Solution converged_in_float = Ours(frozen, in_float, kSteps);
    EXPECT_NEAR(converged_in_float.energy, converged.energy, 1e-10 * converged.energy);
    const Solution many_steps = Ours(frozen, in_float, 25 * kSteps);
    EXPECT_NEAR(many_steps.energy, converged.energy, 1e-10 * converged.energy);
    EXPECT_LT(many_steps.rotation_drift, 1e-14);
    RecordProperty("float_step_energy_excess",
                   fmt::format("{:g}", Ours(frozen, in_float, 1).energy / one_step - 1.0));
    RecordProperty("float_converged_energy_excess",
                   fmt::format("{:g}", converged_in_float.energy / converged.energy - 1.0));
  }
}

}  // namespace
}  // namespace vitruvia::realtime_scape
