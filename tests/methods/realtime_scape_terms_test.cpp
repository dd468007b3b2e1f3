// Each energy term against numeric derivatives, its zeros and its invariance; the whole step
// against Ceres.
#include <functional>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "core/random.h"
#include "methods/realtime_scape/axis_term.h"
#include "methods/realtime_scape/fit_term.h"
#include "methods/realtime_scape/inertia_term.h"
#include "methods/realtime_scape/joint_term.h"
#include "solver/ceres_adaptor.h"
#include "solver/conjugate_gradients.h"
#include "support/tiny_body.h"

namespace vitruvia::realtime_scape {
namespace {

constexpr double kUnit_m = 0.05;
constexpr int kUnknowns = kBoneCount * kBlockSize;
const PinholeCamera kCamera;
const Rigidd kCameraFromRest{Vector3d(1, -1, -1).asDiagonal(), {0.1, 0.9, 2.8}};

Vector3d RandomVector(RandomStream& random, double size) {
  return {random.Normal(0, size), random.Normal(0, size), random.Normal(0, size)};
}

BodyPose RestPose(const Model& model) {
  BodyPose pose;
  for (int j = 0; j < kBoneCount; ++j) {
    pose[j] = {kCameraFromRest.rotation, kCameraFromRest * model.rest_centers[j]};
  }
  return pose;
}

// Moves each bone by an increment as the solver would: exp(r) on the left, translation in units.
BodyPose Moved(BodyPose pose, const Eigen::VectorXd& x) {
  for (int j = 0; j < kBoneCount; ++j) {
    pose[j].rotation = ExpSo3<double>(x.segment<3>(kBlockSize * j)) * pose[j].rotation;
    pose[j].center += kUnit_m * x.segment<3>(kBlockSize * j + 3);
  }
  return pose;
}

Eigen::VectorXd RandomIncrement(std::string_view stream, double size) {
  RandomStream random(5, stream);
  Eigen::VectorXd x(kUnknowns);
  for (int i = 0; i < kUnknowns; ++i) x[i] = random.Normal(0, size);
  return x;
}

PosedSurface Pose(const Model& model, const BodyPose& pose) {
  PosedSurface surface;
  surface.camera_from_rest = ToTransforms(model, pose);
  SkinLinear(model.rest_vertices, model.weights, surface.camera_from_rest, surface.vertices);
  return surface;
}

using Term = std::function<void(const BodyPose&, BlockNormalEquations&)>;

double Energy(const Term& term, const BodyPose& pose) {
  BlockNormalEquations equations(kBoneCount);
  term(pose, equations);
  return equations.energy();
}

// The gradient of a least squares energy is 2 Jᵀr; central differences of the energy itself.
void ExpectGradientMatchesDifferences(const Term& term, const BodyPose& pose, double tolerance) {
  BlockNormalEquations equations(kBoneCount);
  term(pose, equations);
  constexpr double kStep = 1e-5;
  for (int i = 0; i < kUnknowns; ++i) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(kUnknowns, i);
    const double numeric =
        (Energy(term, Moved(pose, step)) - Energy(term, Moved(pose, -step))) / (2 * kStep);
    EXPECT_NEAR(2.0 * equations.gradient()[i], numeric, tolerance * (1.0 + std::abs(numeric)))
        << "unknown " << i;
  }
}

class Terms : public testing::Test {
 protected:
  const BodyModel body_ = TinyBody(2);
  const Model model_{body_};
  const BodyPose rest_ = RestPose(model_);
  const BodyPose near_rest_ = Moved(rest_, RandomIncrement("near", 1e-8));
  const BodyPose bent_ = Moved(rest_, RandomIncrement("bent", 0.2));
  const LocalRotations previous_ = LocalRotationsOf(Moved(rest_, RandomIncrement("previous", 0.1)));

  Term Joint(JointRows rows) const {
    return [this, term = JointTerm(model_, rows)](const BodyPose& pose,
                                                  BlockNormalEquations& equations) {
      term.Add(model_, pose, 10.0, kUnit_m, equations);
    };
  }
  Term Inertia() const {
    return [this](const BodyPose& pose, BlockNormalEquations& equations) {
      AddInertiaTerm(pose, previous_, 5.0, equations);
    };
  }
  static Term Axis() {
    return [](const BodyPose& pose, BlockNormalEquations& equations) {
      AddAxisTerm(pose, 1.0, equations);
    };
  }
  std::vector<Term> RegularizingTerms() const {
    return {Joint(JointRows::kJointPosition), Joint(JointRows::kMeanPoint),
            Joint(JointRows::kAllVertices), Inertia(), Axis()};
  }

  // Pairs of every seventh vertex with a point near it.
  FitData SomePairs(const BodyPose& pose) const {
    RandomStream random(9, "pairs");
    FitData data;
    const PosedSurface surface = Pose(model_, pose);
    for (std::size_t i = 0; i < surface.vertices.size(); i += 7) {
      const Vector3d target = surface.vertices[i].cast<double>() + RandomVector(random, 0.02);
      data.pairs.push_back({static_cast<int>(i), target.cast<float>()});
    }
    return data;
  }
};

TEST_F(Terms, GradientsMatchDifferencesAtRestNearRestAndBent) {
  for (const Term& term : RegularizingTerms()) {
    for (const BodyPose& pose : {rest_, near_rest_, bent_})
      ExpectGradientMatchesDifferences(term, pose, 1e-6);
  }
}

TEST_F(Terms, FitGradientMatchesDifferencesForPairsAndDepths) {
  // Positions are single precision, so the differences carry about 1e-7 m / step: a wider
  // tolerance.
  const FitData pairs = SomePairs(bent_);
  FitData depths;
  for (int i = 0; i < static_cast<int>(model_.rest_vertices.size()); i += 5) {
    depths.classes.near_surface.push_back(i);
    depths.classes.observed_depth.push_back(Pose(model_, bent_).vertices[i].z() + 0.01f);
  }
  FitSettings settings;
  settings.surface_residual = SurfaceResidual::kDepth;
  for (const FitData& data : {pairs, depths}) {
    BlockNormalEquations equations(kBoneCount);
    AddFitTerm(model_, bent_, Pose(model_, bent_), kCamera, data, settings, kUnit_m, equations);
    const auto energy = [&](const BodyPose& pose) {
      BlockNormalEquations e(kBoneCount);
      return AddFitTerm(model_, pose, Pose(model_, pose), kCamera, data, settings, kUnit_m, e);
    };
    for (int i = 0; i < kUnknowns; i += 5) {
      const Eigen::VectorXd step = 1e-2 * Eigen::VectorXd::Unit(kUnknowns, i);
      const double numeric = (energy(Moved(bent_, step)) - energy(Moved(bent_, -step))) / 2e-2;
      EXPECT_NEAR(2.0 * equations.gradient()[i], numeric, 2e-3 * (1.0 + std::abs(numeric)))
          << "unknown " << i;
    }
  }
}

TEST_F(Terms, AreZeroWhereNothingIsAsked) {
  EXPECT_NEAR(Energy(Joint(JointRows::kJointPosition), rest_), 0.0, 1e-20);
  EXPECT_NEAR(Energy(Joint(JointRows::kMeanPoint), rest_), 0.0, 1e-20);
  EXPECT_NEAR(Energy(Joint(JointRows::kAllVertices), rest_), 0.0, 1e-20);
  EXPECT_NEAR(Energy(Axis(), rest_), 0.0, 1e-20);
  BlockNormalEquations equations(kBoneCount);
  EXPECT_NEAR(AddInertiaTerm(bent_, LocalRotationsOf(bent_), 5.0, equations), 0.0, 1e-20);
}

TEST_F(Terms, ExactJointTermIsTheSumOverSharedVertices) {
  double sum = 0.0;
  for (int bone = 1; bone < kBoneCount; ++bone) {
    const int parent = Bones()[bone].parent;
    const BoneTransforms t = ToTransforms(model_, bent_);
    double total = 0.0, weighted = 0.0;
    for (std::size_t i = 0; i < model_.rest_vertices.size(); ++i) {
      double w_bone = 0.0, w_parent = 0.0;
      for (const auto& [b, w] : model_.InfluencesOf(static_cast<int>(i))) {
        if (b == bone) w_bone = w;
        if (b == parent) w_parent = w;
      }
      const Vector3d v = model_.rest_vertices[i].cast<double>();
      total += w_bone * w_parent;
      weighted += w_bone * w_parent * (t[bone] * v - t[parent] * v).squaredNorm();
    }
    ASSERT_GT(total, 0.0) << Bones()[bone].name;
    sum += 10.0 * weighted / total / (kUnit_m * kUnit_m);
  }
  EXPECT_NEAR(Energy(Joint(JointRows::kAllVertices), bent_), sum, 1e-9 * sum);
}

TEST_F(Terms, HingesAreFreeAndTwistsArePenalised) {
  const auto turned = [&](BoneId id, const Vector3d& axis_in_rest) {
    BodyPose pose = rest_;
    const int bone = static_cast<int>(id);
    pose[bone].rotation = pose[bone].rotation * ExpSo3<double>(0.5 * axis_in_rest);
    return Energy(Axis(), pose);
  };
  EXPECT_NEAR(turned(BoneId::kLeftForearm, Vector3d::UnitY()), 0.0, 1e-20);
  EXPECT_GT(turned(BoneId::kLeftForearm, Vector3d::UnitX()), 0.1);
  EXPECT_GT(turned(BoneId::kRightShin, Vector3d::UnitY()), 0.1);
}

TEST_F(Terms, AreInvariantUnderARigidMotionOfEverything) {
  const Rigidd moved_from_camera{ExpSo3<double>({0.3, -0.2, 0.5}), {0.2, 0.1, 0.4}};
  BodyPose moved = bent_;
  for (BonePose& bone : moved)
    bone = {moved_from_camera.rotation * bone.rotation, moved_from_camera * bone.center};
  for (const Term& term :
       {Joint(JointRows::kJointPosition), Joint(JointRows::kAllVertices), Axis()}) {
    EXPECT_NEAR(Energy(term, moved), Energy(term, bent_), 1e-9 * Energy(term, bent_));
  }
}

TEST_F(Terms, FromOneStartStepsReachTheOptimumThatCeresFinds) {
  const FitData data = SomePairs(bent_);
  const FitSettings fit;
  const JointTerm joints(model_, JointRows::kJointPosition);

  // Our steps: linearise, solve, compose, on frozen correspondences.
  BodyPose pose = rest_;
  BlockNormalEquations equations(kBoneCount);
  ConjugateGradients solver;
  const auto assemble = [&](const BodyPose& at) {
    equations.Reset();
    AddFitTerm(model_, at, Pose(model_, at), kCamera, data, fit, kUnit_m, equations);
    joints.Add(model_, at, 10.0, kUnit_m, equations);
    AddInertiaTerm(at, previous_, 5.0, equations);
    AddAxisTerm(at, 1.0, equations);
    equations.Symmetrize();
    return equations.energy();
  };
  for (int i = 0; i < 40; ++i) {
    assemble(pose);
    Eigen::VectorXd x;
    solver.Solve(equations.hessian(), -equations.gradient(), 1e-12, 400, x);
    pose = Moved(pose, x);
  }

  // Ceres: the same residuals in double, written out independently.
  const auto residuals = [&](const Eigen::VectorXd& x) {
    const BodyPose at = Moved(rest_, x);
    const BoneTransforms t = ToTransforms(model_, at);
    std::vector<double> r;
    const auto add = [&](const Vector3d& v, double weight) {
      for (int k = 0; k < 3; ++k) r.push_back(std::sqrt(weight) * v[k]);
    };
    for (const Pair& pair : data.pairs) {
      Vector3d v = Vector3d::Zero();
      for (const auto& [bone, w] : model_.InfluencesOf(pair.vertex)) {
        v += double{w} * (t[bone] * model_.rest_vertices[pair.vertex].cast<double>());
      }
      add((v - pair.target.cast<double>()) / kUnit_m, 1.0);
    }
    for (int j = 0; j < kBoneCount; ++j) {
      const int parent = Bones()[j].parent;
      const Matrix3<double> predicted =
          parent < 0 ? previous_[j] : at[parent].rotation * previous_[j];
      for (int c = 0; c < 3; ++c) add(at[j].rotation.col(c) - predicted.col(c), 5.0);
      if (parent >= 0)
        add((t[j] * body_.skeleton.joints[j] - t[parent] * body_.skeleton.joints[j]) / kUnit_m,
            10.0);
    }
    const auto hinge = [&](BoneId id, const Vector3d& d) {
      const int j = static_cast<int>(id);
      add(at[j].rotation * d - at[Bones()[j].parent].rotation * d, 1.0);
    };
    for (const BoneId id : {BoneId::kHead, BoneId::kLeftForearm, BoneId::kRightForearm})
      hinge(id, Vector3d::UnitY());
    for (const BoneId id :
         {BoneId::kLeftShin, BoneId::kRightShin, BoneId::kLeftFoot, BoneId::kRightFoot}) {
      hinge(id, Vector3d::UnitX());
    }
    return Eigen::VectorXd(
        Eigen::Map<Eigen::VectorXd>(r.data(), static_cast<Eigen::Index>(r.size())));
  };
  const CeresResult reference = MinimizeWithCeres(residuals, Eigen::VectorXd::Zero(kUnknowns));
  ASSERT_TRUE(reference.usable) << reference.report;
  // Same energy, two independent ways of writing it; positions of the fit are single precision.
  EXPECT_NEAR(assemble(pose), reference.energy, 1e-4 * reference.energy) << reference.report;
  EXPECT_LT(assemble(pose), 0.9 * assemble(rest_));
}

}  // namespace
}  // namespace vitruvia::realtime_scape
