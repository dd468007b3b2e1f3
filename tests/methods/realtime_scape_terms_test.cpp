// Each energy term against numeric derivatives, its zeros and its invariance; the whole step
// against Ceres.
#include <algorithm>
#include <cmath>
#include <functional>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "core/random.h"
#include "methods/realtime_scape/axis_term.h"
#include "methods/realtime_scape/bone_sight.h"
#include "methods/realtime_scape/fit_term.h"
#include "methods/realtime_scape/inertia_term.h"
#include "methods/realtime_scape/joint_term.h"
#include "methods/realtime_scape/prediction.h"
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
  PoseSurface(model, pose, surface);
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
  settings.kernel = RobustKernel::kNone;
  for (const FitData& data : {pairs, depths}) {
    BlockNormalEquations equations(kBoneCount);
    AddFitTerm(model_, bent_, kCamera, data, settings, kUnit_m, equations);
    const auto energy = [&](const BodyPose& pose) {
      BlockNormalEquations e(kBoneCount);
      return AddFitTerm(model_, pose, kCamera, data, settings, kUnit_m, e);
    };
    for (int i = 0; i < kUnknowns; i += 5) {
      const Eigen::VectorXd step = 1e-2 * Eigen::VectorXd::Unit(kUnknowns, i);
      const double numeric = (energy(Moved(bent_, step)) - energy(Moved(bent_, -step))) / 2e-2;
      EXPECT_NEAR(2.0 * equations.gradient()[i], numeric, 2e-3 * (1.0 + std::abs(numeric)))
          << "unknown " << i;
    }
  }
}

TEST(RobustWeight, LeavesAllToSmallResidualsAndLessToLargeOnes) {
  EXPECT_EQ(RobustWeight(RobustKernel::kNone, 5.0, 0.01), 1.0);
  EXPECT_EQ(RobustWeight(RobustKernel::kHuber, -0.01, 0.01), 1.0);
  EXPECT_DOUBLE_EQ(RobustWeight(RobustKernel::kHuber, -0.04, 0.01), 0.25);
  EXPECT_EQ(RobustWeight(RobustKernel::kTukey, 0.0, 0.01), 1.0);
  EXPECT_DOUBLE_EQ(RobustWeight(RobustKernel::kTukey, 0.005, 0.01), 0.5625);
  EXPECT_EQ(RobustWeight(RobustKernel::kTukey, 0.02, 0.01), 0.0);
}

TEST_F(Terms, APlanePairAsksNothingAlongThePlane) {
  FitData data;
  const PosedSurface surface = Pose(model_, rest_);
  // A target slid along the surface at one vertex of the rest pose.
  const Vector3d normal =
      (kCameraFromRest.rotation * model_.rest_normals[10].cast<double>()).normalized();
  const Vector3d along = normal.cross(Vector3d(0.3, 0.5, 0.7)).normalized();
  const Vector3d target = surface.vertices[10].cast<double>() + 0.03 * along + 0.01 * normal;
  data.pairs.push_back({10, target.cast<float>()});
  FitSettings settings;
  settings.kernel = RobustKernel::kNone;
  settings.pair_residual = PairResidual::kPlane;
  BlockNormalEquations plane(kBoneCount), point(kBoneCount);
  EXPECT_NEAR(AddFitTerm(model_, rest_, kCamera, data, settings, kUnit_m, plane),
              std::pow(0.01 / kUnit_m, 2), 1e-5);
  settings.pair_residual = PairResidual::kPoint;
  EXPECT_NEAR(AddFitTerm(model_, rest_, kCamera, data, settings, kUnit_m, point),
              0.001 / (kUnit_m * kUnit_m), 1e-5);
}

TEST_F(Terms, PredictionTurnsJointsOnAndLetsUnseenOnesComeToRest) {
  const int forearm = static_cast<int>(BoneId::kLeftForearm);
  const Matrix3<double> turn = ExpSo3<double>({0.0, 0.1, 0.0});
  BodyPose last = rest_;
  last[forearm].rotation = last[forearm].rotation * turn;
  BoneSight sight(model_);
  const VertexClasses nothing;
  const MotionSettings constant{.model = MotionModel::kConstantRotation};
  EXPECT_EQ(PredictPose(model_, last, rest_, sight, constant).pose[forearm].rotation,
            last[forearm].rotation);

  const MotionSettings velocity{.velocity_share = 1.0, .hidden_decay = 0.5};
  const auto predicted_turn = [&] {
    const Prediction p = PredictPose(model_, last, rest_, sight, velocity);
    return LogSo3<double>(
        Matrix3<double>(rest_[forearm].rotation.transpose() * p.pose[forearm].rotation));
  };
  EXPECT_TRUE(predicted_turn().isApprox(Vector3d(0.0, 0.2, 0.0), 1e-9));
  sight.Count(model_, {}, nothing);
  sight.EndFrame(0.05);
  EXPECT_EQ(sight.frames_unseen(forearm), 1);
  EXPECT_TRUE(predicted_turn().isApprox(Vector3d(0.0, 0.15, 0.0), 1e-9));

  // The whole body's own motion goes on too.
  BodyPose shifted = rest_;
  for (BonePose& bone : shifted) bone.center += Vector3d(0.01, 0.0, 0.02);
  BoneSight all_seen(model_);
  const Prediction p = PredictPose(model_, shifted, rest_, all_seen, velocity);
  for (int j = 0; j < kBoneCount; ++j) {
    EXPECT_TRUE(p.pose[j].center.isApprox(rest_[j].center + Vector3d(0.02, 0.0, 0.04), 1e-9)) << j;
  }
}

TEST_F(Terms, PointsMayPullAtBonesThatLackThemAndAtUnseenOnes) {
  const PosedSurface surface = Pose(model_, rest_);
  const int hand = static_cast<int>(BoneId::kLeftHand), chest = static_cast<int>(BoneId::kChest);
  std::vector<int> visible;
  VertexClasses classes;
  for (int i = 0; i < static_cast<int>(model_.rest_vertices.size()); ++i) {
    const int bone = model_.weights.bones[i][0];
    if (bone == hand) continue;  // out of sight
    visible.push_back(i);
    if (bone == chest) classes.near_surface.push_back(i);  // and the chest has its points
  }
  BoneSight sight(model_);
  sight.Count(model_, visible, classes);
  const FitSettings fit;
  const SearchSettings reach{.growth_m = 0.02, .reach_m = 0.1};
  CandidateFinder finder(model_);
  std::vector<int> candidates, settled;
  const auto has = [&](const std::vector<int>& vertices, int bone) {
    return std::any_of(vertices.begin(), vertices.end(),
                       [&](int i) { return model_.weights.bones[i][0] == bone; });
  };
  finder.Find(model_, surface, visible, sight, reach, candidates, settled);
  EXPECT_FALSE(has(candidates, chest));
  EXPECT_TRUE(has(settled, chest));
  EXPECT_FALSE(has(candidates, hand)) << "it was seen a frame ago";
  EXPECT_TRUE(has(candidates, static_cast<int>(BoneId::kHead)));
  EXPECT_DOUBLE_EQ(ReachOf(hand, sight, fit, reach), fit.pair_cutoff_m);

  sight.EndFrame(0.05);
  finder.Find(model_, surface, visible, sight, reach, candidates, settled);
  EXPECT_TRUE(has(candidates, hand));
  EXPECT_DOUBLE_EQ(ReachOf(hand, sight, fit, reach), fit.pair_cutoff_m + 0.02);
  EXPECT_DOUBLE_EQ(ReachOf(chest, sight, fit, reach), fit.pair_cutoff_m);
  sight.EndFrame(0.05);
  EXPECT_DOUBLE_EQ(ReachOf(hand, sight, fit, reach), reach.reach_m);

  const SearchSettings paper{.candidates = PairCandidates::kVisible};
  finder.Find(model_, surface, visible, sight, paper, candidates, settled);
  EXPECT_EQ(candidates, visible);
  EXPECT_TRUE(settled.empty());
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
  FitSettings fit;
  fit.kernel =
      RobustKernel::kNone;  // its weights change from step to step, and the energy with them
  const JointTerm joints(model_, JointRows::kJointPosition);

  // Our steps: linearise, solve, compose, on frozen correspondences.
  BodyPose pose = rest_;
  BlockNormalEquations equations(kBoneCount);
  ConjugateGradients solver;
  const auto assemble = [&](const BodyPose& at) {
    equations.Reset();
    AddFitTerm(model_, at, kCamera, data, fit, kUnit_m, equations);
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
  // Same energy, two independent ways of writing it.
  EXPECT_NEAR(assemble(pose), reference.energy, 1e-6 * reference.energy) << reference.report;
  EXPECT_LT(assemble(pose), 0.9 * assemble(rest_));
}

}  // namespace
}  // namespace vitruvia::realtime_scape
