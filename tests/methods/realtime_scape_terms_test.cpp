// Each energy term against numeric derivatives, its zeros and its invariance.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "body/bone_limits.h"
#include "body/pose_statistics.h"
#include "math/angles.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "methods/posed_tiny_body.h"
#include "methods/realtime_scape/terms/axis_term.h"
#include "methods/realtime_scape/terms/energy_terms.h"
#include "methods/realtime_scape/terms/fit_term.h"
#include "methods/realtime_scape/terms/free_space_term.h"
#include "methods/realtime_scape/terms/inertia_term.h"
#include "methods/realtime_scape/terms/joint_term.h"
#include "methods/realtime_scape/terms/limit_term.h"
#include "methods/realtime_scape/terms/local_rotation_row.h"
#include "methods/realtime_scape/terms/prior_term.h"

namespace vitruvia::realtime_scape {
namespace {

using Term = std::function<void(const BodyPose&, BlockNormalEquations&)>;

double Energy(const Term& term, const BodyPose& pose) {
  BlockNormalEquations equations(kBoneCount);
  term(pose, equations);
  return equations.energy();
}

// The gradient of a least squares energy is 2 Jᵀr; central differences of the energy itself.
void ExpectGradientMatchesDifferences(const Term& term, const BodyPose& pose) {
  constexpr double kStep = 1e-5, kTolerance = 1e-6;
  BlockNormalEquations equations(kBoneCount);
  term(pose, equations);
  for (int i = 0; i < kUnknowns; ++i) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(kUnknowns, i);
    const double numeric =
        (Energy(term, Moved(pose, step)) - Energy(term, Moved(pose, -step))) / (2 * kStep);
    EXPECT_NEAR(2.0 * equations.gradient()[i], numeric, kTolerance * (1.0 + std::abs(numeric)))
        << "unknown " << i;
  }
}

// Where the energy is 0, its second derivative along d is 2 dᵀJᵀJ d: what a frozen normal adds to
// the derivative is 0 there too.
void ExpectCurvatureMatchesDifferences(const Term& term, const BodyPose& pose) {
  constexpr double kStep = 1e-4, kTolerance = 1e-3;  // targets are rounded to single precision
  BlockNormalEquations equations(kBoneCount);
  term(pose, equations);
  equations.Symmetrize();
  ASSERT_LT(equations.energy(), 1e-6);
  for (int k = 0; k < 5; ++k) {
    const Eigen::VectorXd d = RandomIncrement("direction" + std::to_string(k), 1.0);
    const double numeric = (Energy(term, Moved(pose, kStep * d)) +
                            Energy(term, Moved(pose, -kStep * d)) - 2.0 * equations.energy()) /
                           (kStep * kStep);
    const double analytic = 2.0 * d.dot(equations.hessian() * d);
    EXPECT_NEAR(analytic, numeric, kTolerance * analytic);
  }
}

class Terms : public testing::Test, protected PosedTinyBody {
 protected:
  Term Joint(JointRows rows) const {
    return [this, term = JointTerm(model, rows)](const BodyPose& pose,
                                                 BlockNormalEquations& equations) {
      term.Add(model, pose, 10.0, kUnit_m, equations);
    };
  }
  static Term Inertia(const LocalRotations& before) {
    return [before](const BodyPose& pose, BlockNormalEquations& equations) {
      AddInertiaTerm(pose, before, 5.0, equations);
    };
  }
  static Term Axis() {
    return [](const BodyPose& pose, BlockNormalEquations& equations) {
      AddAxisTerm(pose, 1.0, equations);
    };
  }
  static Term Limit(double slack_rad) {
    return [slack_rad](const BodyPose& pose, BlockNormalEquations& equations) {
      AddLimitTerm(pose, slack_rad, 20.0, equations);
    };
  }
  static Term Prior() {
    return [](const BodyPose& pose, BlockNormalEquations& equations) {
      AddPriorTerm(pose, 0.1, equations);
    };
  }
  // Vertices drawn to where those pairs say.
  Term Free(const FitData& data) const {
    FitSettings settings;
    settings.kernel = RobustKernel::kNone;
    return [this, data, settings](const BodyPose& pose, BlockNormalEquations& equations) {
      AddFreeSpaceTerm(model, pose, {data.pairs}, settings, 0.5, kUnit_m, equations);
    };
  }
  // One bone turned against the rest pose, with all that hangs from it.
  BodyPose Turned(BoneId bone_id, const Vector3d& angles_deg) const {
    BodyPose pose = rest;
    const int turned = static_cast<int>(bone_id);
    pose[turned].rotation *= ExpSo3<double>(kRadiansPerDegree * angles_deg);
    for (int bone = turned + 1; bone < kBoneCount; ++bone) {
      const int parent = Bones()[bone].parent;
      pose[bone].rotation =
          pose[parent].rotation * RelativeRotation(rest[parent].rotation, rest[bone].rotation);
    }
    return pose;
  }
  Term Fit(const FitData& data, SurfaceResidual surface, PairResidual pair,
           RobustKernel kernel = RobustKernel::kNone) const {
    const FitSettings settings{
        .surface_residual = surface, .pair_residual = pair, .kernel = kernel};
    return [this, data, settings](const BodyPose& pose, BlockNormalEquations& equations) {
      AddFitTerm(model, pose, camera, data.classes, data.pairs, settings, kUnit_m, equations);
    };
  }
  Term FitPoints(const FitData& data) const {
    return Fit(data, SurfaceResidual::kDepth, PairResidual::kPoint);
  }
  Term FitPlanes(const FitData& data) const {
    return Fit(data, SurfaceResidual::kPlane, PairResidual::kPlane);
  }
  std::vector<Term> JointTerms() const {
    return {Joint(JointRows::kJointPosition), Joint(JointRows::kMeanPoint),
            Joint(JointRows::kAllVertices)};
  }
};

TEST_F(Terms, GradientsOfWhatRegularizesMatchDifferences) {
  std::vector<Term> terms = JointTerms();
  terms.push_back(Inertia(previous));
  terms.push_back(Axis());
  terms.push_back(Prior());
  terms.push_back(Limit(0.05));  // at 0 an elbow of the rest pose is on the edge of its range
  for (const Term& term : terms) {
    for (const BodyPose& pose : {rest, near_rest, bent, Articulated()})
      ExpectGradientMatchesDifferences(term, pose);
  }
}

TEST_F(Terms, GradientsOfTheFitMatchDifferences) {
  for (const BodyPose& pose : {rest, near_rest, bent, Articulated()}) {
    ExpectGradientMatchesDifferences(FitPoints(Pairs(pose, 7, 0.02)), pose);
    ExpectGradientMatchesDifferences(FitPoints(Depths(pose, 5, 0.02)), pose);
    ExpectGradientMatchesDifferences(Free(Pairs(pose, 7, 0.02)), pose);
  }
}

TEST_F(Terms, CurvatureOfPlaneRowsMatchesDifferences) {
  for (const BodyPose& pose : {rest, near_rest, bent, Articulated()}) {
    ExpectCurvatureMatchesDifferences(FitPlanes(Pairs(pose, 7, 0.0)), pose);
  }
}

TEST_F(Terms, CurvatureOfDepthRowsMatchesDifferences) {
  for (const BodyPose& pose : {rest, near_rest, bent, Articulated()}) {
    ExpectCurvatureMatchesDifferences(FitPoints(Depths(pose, 5, 0.0)), pose);
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

TEST(InverseRightJacobian, LinearizesTheLogarithmUpToATurnAndAHalf) {
  const Vector3d axis = Vector3d(0.3, -0.5, 0.8).normalized(), step(0.2e-6, -0.3e-6, 0.1e-6);
  for (const double angle : {0.0, 1e-5, 0.5, 2.0, 3.1, 3.2, 4.5}) {
    const Vector3d before = angle * axis;
    Vector3d after = LogSo3<double>(ExpSo3<double>(before) * ExpSo3<double>(step));
    if (angle > 3.15) after = OtherWayRound(after);
    EXPECT_LT((before + InverseRightJacobian(before) * step - after).norm(), 1e-10) << angle;
  }
}

TEST_F(Terms, LimitsAreFreeWithinTheRangeAndCostTheSquaredExcessBeyondIt) {
  struct Case {
    BoneId bone;
    Vector3d angles_deg;
    double excess_deg;
  };
  using enum BoneId;
  for (const Case& turn :
       {Case{kChest, {30, 20, -15}, 0}, Case{kChest, {50, 0, 0}, 10},
        Case{kChest, {0, -30, 0}, 7.5}, Case{kLeftForearm, {0, -140, 0}, 0},
        Case{kLeftForearm, {0, 25, 0}, 25}, Case{kRightForearm, {0, 140, 0}, 0},
        Case{kRightForearm, {0, -25, 0}, 25}, Case{kLeftShin, {120, 0, 0}, 0},
        Case{kLeftShin, {-20, 0, 0}, 20}, Case{kRightThigh, {0, 0, -40}, 0},
        Case{kRightThigh, {0, 0, 50}, 20}, Case{kLeftUpperArm, {0, 0, 170}, 0}}) {
    const double excess_rad = turn.excess_deg * kRadiansPerDegree;
    const BodyPose pose = Turned(turn.bone, turn.angles_deg);
    EXPECT_NEAR(Energy(Limit(0.0), pose), 20.0 * excess_rad * excess_rad, 1e-9)
        << Bones()[static_cast<int>(turn.bone)].name << " " << turn.angles_deg.transpose();
    EXPECT_EQ(Energy(Limit(excess_rad + 0.01), pose), 0.0);
  }
}

// A forearm that is bent and turned by more than half a turn in all: 140 degrees about the hinge
// with the carrying axis of captured elbows. Its shorter rotation vector bends backwards.
TEST_F(Terms, ABentElbowIsWithinItsRangeThoughItsRotationVectorIsLongerThanPi) {
  const Vector3d bent_deg(0.0, -145.0, 110.0);
  ASSERT_GT(bent_deg.norm(), 180.0);
  const BodyPose pose = Turned(BoneId::kLeftForearm, bent_deg);
  EXPECT_EQ(Energy(Limit(0.0), pose), 0.0);
}

TEST_F(Terms, ThePriorIsZeroAtTheUsualPoseAndCountsDeviations) {
  BodyPose usual = rest;
  for (int bone = 1; bone < kBoneCount; ++bone) {
    usual[bone].rotation =
        usual[Bones()[bone].parent].rotation * CapturedPoseStatistics()[bone].mean;
  }
  EXPECT_NEAR(Energy(Prior(), usual), 0.0, 1e-15);
  // A head, from which nothing hangs, two deviations off.
  const int head = static_cast<int>(BoneId::kHead);
  const double angle_rad = 2.0 * CapturedPoseStatistics()[head].deviation_rad.y();
  usual[head].rotation *= ExpSo3<double>({0.0, angle_rad, 0.0});
  EXPECT_NEAR(Energy(Prior(), usual), 0.1 * 4.0, 1e-12);
}

TEST_F(Terms, SensorNoiseDividesARowsWeightByTheVarianceAlongIt) {
  NoiseSettings noise;
  const Vector3d before_camera(0.0, 0.0, 2.0);
  EXPECT_EQ(NoiseWeight(noise, before_camera, Vector3d::UnitZ()), 1.0);
  noise.model_deviation_m = 0.01;
  noise.sensor.axial_base_m = 0.02;
  noise.sensor.lateral_rad = 0.005;  // 0.01 m at 2 m
  EXPECT_DOUBLE_EQ(NoiseWeight(noise, before_camera, Vector3d::UnitZ()), 1.0 / (1.0 + 4.0));
  EXPECT_DOUBLE_EQ(NoiseWeight(noise, before_camera, Vector3d::UnitX()), 1.0 / (1.0 + 1.0));
  const Vector3d slanted(0.6, 0.0, 0.8);
  EXPECT_NEAR(NoiseWeight(noise, before_camera, slanted), 1.0 / (1.0 + 0.64 * 4.0 + 0.36), 1e-15);
}

TEST_F(Terms, AVertexLeavesFreeSpaceAlongItsLineOfSightOrToTheNearestMeasurement) {
  const std::vector<Vector3f> vertices{
      camera.Unproject(10.0f, 10.0f, 2.0f), camera.Unproject(20.0f, 10.0f, 2.0f),
      camera.Unproject(26.0f, 10.0f, 2.0f), camera.Unproject(31.0f, 10.0f, 2.0f)};
  DepthImage captured(camera.width, camera.height);
  captured(10, 10) = 2.05f;                    // behind the first vertex
  captured(30, 10) = captured(20, 18) = 2.5f;  // 8 pixels below the second, 4 and 1 from the others
  VertexClasses classes;
  classes.elsewhere = {0, 1, 2, 3};
  FreeSpace free_space;
  FindFreeSpace(vertices, classes, captured, camera, FitSettings{}, free_space);
  ASSERT_EQ(free_space.ways_out.size(), 3u);  // the last is within the margin of an edge
  const std::array expected{camera.Unproject(10.0f, 10.0f, 2.05f),
                            camera.Unproject(20.0f, 18.0f, 2.0f),
                            camera.Unproject(30.0f, 10.0f, 2.0f)};
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(free_space.ways_out[k].vertex, k);
    EXPECT_LT((free_space.ways_out[k].target - expected[k]).norm(), 1e-6f) << k;
  }
}

TEST_F(Terms, AVertexNearTheBorderLeavesTheImage) {
  const auto right = static_cast<float>(camera.width - 1),
             low = static_cast<float>(camera.height - 4);
  const std::vector<Vector3f> vertices{
      camera.Unproject(1.0f, 10.0f, 2.0f), camera.Unproject(right, 30.0f, 2.0f),
      camera.Unproject(50.0f, low, 2.0f), camera.Unproject(60.0f, low, 2.0f)};
  DepthImage captured(camera.width, camera.height);
  captured(1, 10) = captured(camera.width - 1, 30) = 2.9f;
  captured(50, camera.height - 9) = 2.5f;  // 5 pixels from the third vertex, the border 4
  captured(60, camera.height - 7) = 2.5f;  // 3 pixels from the last one
  VertexClasses classes;
  classes.elsewhere = {0, 1, 2, 3};
  FreeSpace free_space;
  FindFreeSpace(vertices, classes, captured, camera, FitSettings{}, free_space);
  const auto below = static_cast<float>(camera.height);
  const std::array expected{
      camera.Unproject(-1.0f, 10.0f, 2.0f), camera.Unproject(right + 1.0f, 30.0f, 2.0f),
      camera.Unproject(50.0f, below, 2.0f), camera.Unproject(60.0f, below - 7.0f, 2.0f)};
  ASSERT_EQ(free_space.ways_out.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k)
    EXPECT_LT((free_space.ways_out[k].target - expected[k]).norm(), 1e-6f) << k;
}

TEST_F(Terms, APlanePairAsksNothingAlongThePlane) {
  FitData data;
  const PosedSurface surface = Surface(rest);
  // A target slid along the surface at one vertex of the rest pose.
  const Vector3d normal =
      (camera_from_rest.rotation * model.rest_normals[10].cast<double>()).normalized();
  const Vector3d along = normal.cross(Vector3d(0.3, 0.5, 0.7)).normalized();
  const Vector3d target = surface.vertices[10].cast<double>() + 0.03 * along + 0.01 * normal;
  data.pairs.push_back({10, target.cast<float>()});
  FitSettings settings;
  settings.kernel = RobustKernel::kNone;
  settings.pair_residual = PairResidual::kPlane;
  BlockNormalEquations plane(kBoneCount), point(kBoneCount);
  AddFitTerm(model, rest, camera, data.classes, data.pairs, settings, kUnit_m, plane);
  EXPECT_NEAR(plane.energy(), std::pow(0.01 / kUnit_m, 2), 1e-5);
  settings.pair_residual = PairResidual::kPoint;
  AddFitTerm(model, rest, camera, data.classes, data.pairs, settings, kUnit_m, point);
  EXPECT_NEAR(point.energy(), 0.001 / (kUnit_m * kUnit_m), 1e-5);
}

TEST_F(Terms, TheFitIsZeroWhereEveryVertexIsWhereItWasSeen) {
  for (const BodyPose& pose : {rest, bent, Articulated()}) {
    const double rounding = 1e-9;  // of targets, which are in single precision
    for (const FitData& data : {Pairs(pose, 1, 0.0), Depths(pose, 1, 0.0)}) {
      EXPECT_NEAR(Energy(FitPoints(data), pose), 0.0, rounding * VertexCount());
      EXPECT_NEAR(Energy(FitPlanes(data), pose), 0.0, rounding * VertexCount());
    }
  }
}

TEST_F(Terms, AVertexOfV1CountsByItsWeight) {
  FitData data = Depths(bent, 7, 0.002);
  const double energy = Energy(FitPoints(data), bent);
  ASSERT_GT(energy, 0.0);
  for (float& weight : data.classes.weight) weight = 0.25f;
  EXPECT_NEAR(Energy(FitPoints(data), bent), 0.25 * energy, 1e-12 * energy);
}

TEST_F(Terms, RobustKernelsChangeNothingWhereResidualsAreSmall) {
  const FitData data = Pairs(bent, 7, 1e-4);
  const double plain = Energy(FitPoints(data), bent);
  ASSERT_GT(plain, 0.0);
  EXPECT_EQ(
      plain,
      Energy(Fit(data, SurfaceResidual::kDepth, PairResidual::kPoint, RobustKernel::kHuber), bent));
}

TEST_F(Terms, JointsAreWholeInEveryPoseThatABodyCanTake) {
  for (const BodyPose& pose : {rest, Articulated()}) {
    EXPECT_NEAR(Energy(Joint(JointRows::kJointPosition), pose), 0.0, 1e-20);
  }
  // The vertices that two bones share lie round the joint, so they part where it bends.
  EXPECT_NEAR(Energy(Joint(JointRows::kMeanPoint), rest), 0.0, 1e-20);
  EXPECT_NEAR(Energy(Joint(JointRows::kAllVertices), rest), 0.0, 1e-20);
  EXPECT_GT(Energy(Joint(JointRows::kAllVertices), Articulated()), 1.0);
  BodyPose torn = Articulated();
  torn[static_cast<int>(BoneId::kLeftHand)].center.x() += kUnit_m;
  EXPECT_NEAR(Energy(Joint(JointRows::kJointPosition), torn), 10.0, 1e-9);  // α₁ · 1²
}

TEST_F(Terms, InertiaIsZeroWhileEveryJointHoldsStill) {
  for (const BodyPose& pose : {rest, bent, Articulated()}) {
    EXPECT_NEAR(Energy(Inertia(LocalRotationsOf(pose)), pose), 0.0, 1e-20);
  }
  // One joint turns by φ, and with it all that hangs from it: α₂ ‖R − I‖² = α₂ 8 sin²(φ/2).
  const double angle = 0.3;
  JointPose joints = JointPose::Rest(body.skeleton);
  joints.local_rotations[static_cast<int>(BoneId::kLeftUpperArm)] =
      ExpSo3<double>({0.0, angle, 0.0});
  const BoneTransforms bones = ForwardKinematics(body.skeleton, joints);
  BodyPose turned = rest;
  for (int j = 0; j < kBoneCount; ++j) turned[j].rotation = rest[j].rotation * bones[j].rotation;
  EXPECT_NEAR(Energy(Inertia(LocalRotationsOf(rest)), turned),
              5.0 * 8.0 * std::pow(std::sin(0.5 * angle), 2), 1e-12);
}

// The list adds every term with its own weight, and says which energy is whose.
TEST_F(Terms, TheListAddsEachTermOnceWithItsWeight) {
  const FitData data = Pairs(bent, 7, 0.02);
  Settings settings;
  settings.length_unit_m = kUnit_m;
  settings.weights[EnergyTerm::kJoint] = 3.0;
  settings.weights[EnergyTerm::kInertia] = 5.0;
  settings.weights[EnergyTerm::kAxis] = 7.0;
  const JointTerm joints(model, settings.joint_rows);
  BlockNormalEquations all(kBoneCount), single(kBoneCount);
  settings.weights[EnergyTerm::kFreeSpace] = 2.0;
  settings.weights[EnergyTerm::kLimit] = 11.0;
  settings.weights[EnergyTerm::kPrior] = 13.0;
  settings.limit_slack_deg = 0.0;
  const FreeSpace free_space{{Pair{3, Vector3f(0.1f, 0.2f, 2.0f)}}};
  const Energies energies = AddEnergyTerms(
      {model, camera, settings, joints, bent, previous, data.classes, data.pairs, free_space}, all);
  const auto energy_of = [&](EnergyTerm term) { return energies[static_cast<std::size_t>(term)]; };
  AddFitTerm(model, bent, camera, data.classes, data.pairs, settings.fit, kUnit_m, single);
  EXPECT_DOUBLE_EQ(energy_of(EnergyTerm::kFit), single.energy());
  const double tolerance = 1e-9 * all.energy();  // differences of running sums
  EXPECT_NEAR(energy_of(EnergyTerm::kJoint), 0.3 * Energy(Joint(settings.joint_rows), bent),
              tolerance);
  EXPECT_NEAR(energy_of(EnergyTerm::kInertia), Energy(Inertia(previous), bent), tolerance);
  EXPECT_NEAR(energy_of(EnergyTerm::kAxis), 7.0 * Energy(Axis(), bent), tolerance);
  BlockNormalEquations freed(kBoneCount);
  AddFreeSpaceTerm(model, bent, free_space, settings.fit, 2.0, kUnit_m, freed);
  EXPECT_NEAR(energy_of(EnergyTerm::kFreeSpace), freed.energy(), tolerance);
  EXPECT_NEAR(energy_of(EnergyTerm::kLimit), 11.0 / 20.0 * Energy(Limit(0.0), bent), tolerance);
  EXPECT_NEAR(energy_of(EnergyTerm::kPrior), 130.0 * Energy(Prior(), bent), tolerance);
  EXPECT_STREQ(Name(EnergyTerm::kInertia), "inertia");
}

// A linear rotation update leaves matrices that are no rotations: R ← (I + r̂) R. A joint that has
// not moved costs nothing there either.
TEST_F(Terms, InertiaIsZeroWhileJointsHoldStillThoughRotationsHaveDriftedAway) {
  BodyPose drifted = Articulated();
  for (int j = 0; j < kBoneCount; ++j) {
    const Vector3d step(0.1, -0.05 * j, 0.02 * j);
    drifted[j].rotation += (Skew<double>(step) * drifted[j].rotation).eval();
  }
  EXPECT_NEAR(Energy(Inertia(LocalRotationsOf(drifted)), drifted), 0.0, 1e-20);
}

TEST_F(Terms, ExactJointTermIsTheSumOverSharedVertices) {
  double sum = 0.0;
  for (int bone = 1; bone < kBoneCount; ++bone) {
    const int parent = Bones()[bone].parent;
    const BoneTransforms t = ToTransforms(model, bent);
    double total = 0.0, weighted = 0.0;
    for (std::size_t i = 0; i < model.rest_vertices.size(); ++i) {
      double w_bone = 0.0, w_parent = 0.0;
      for (const auto& [b, w] : model.InfluencesOf(static_cast<int>(i))) {
        if (b == bone) w_bone = w;
        if (b == parent) w_parent = w;
      }
      const Vector3d v = model.rest_vertices[i].cast<double>();
      total += w_bone * w_parent;
      weighted += w_bone * w_parent * (t[bone] * v - t[parent] * v).squaredNorm();
    }
    ASSERT_GT(total, 0.0) << Bones()[bone].name;
    sum += 10.0 * weighted / total / (kUnit_m * kUnit_m);
  }
  EXPECT_NEAR(Energy(Joint(JointRows::kAllVertices), bent), sum, 1e-9 * sum);
}

// The paper's seven bones. A hinge about the bone's axis is free, a twist costs
// α₃ ‖R d − d‖² = α₃ 4 sin²(φ/2).
TEST_F(Terms, HingesAreFreeAndTwistsArePenalized) {
  const double angle = 0.5;
  const auto turned = [&](BoneId id, const Vector3d& axis_in_rest) {
    BodyPose pose = rest;
    const int bone = static_cast<int>(id);
    pose[bone].rotation = pose[bone].rotation * ExpSo3<double>(angle * axis_in_rest);
    return Energy(Axis(), pose);
  };
  struct Hinge {
    BoneId bone;
    Vector3d free, twist;
  };
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  const double cost = 4.0 * std::pow(std::sin(0.5 * angle), 2);
  for (const Hinge& hinge : {Hinge{BoneId::kHead, y, z}, Hinge{BoneId::kLeftForearm, y, x},
                             Hinge{BoneId::kRightForearm, y, x}, Hinge{BoneId::kLeftFoot, x, z},
                             Hinge{BoneId::kRightFoot, x, z}}) {
    EXPECT_NEAR(turned(hinge.bone, hinge.free), 0.0, 1e-20);
    EXPECT_NEAR(turned(hinge.bone, hinge.twist), cost, 1e-12);
  }
  // A shin's turn carries no foot along here, so the foot's own hinge is asked as well.
  for (const BoneId shin : {BoneId::kLeftShin, BoneId::kRightShin}) {
    EXPECT_NEAR(turned(shin, x), 0.0, 1e-20);
    EXPECT_NEAR(turned(shin, y), 2.0 * cost, 1e-12);
  }
  // The others are free to turn, but where a hinge hangs from them.
  for (const BoneId other :
       {BoneId::kLeftHand, BoneId::kRightHand, BoneId::kPelvis, BoneId::kAbdomen, BoneId::kChest}) {
    EXPECT_NEAR(turned(other, x), 0.0, 1e-20);
  }
}

TEST_F(Terms, AreInvariantUnderARigidMotionOfEverything) {
  const Rigidd moved_from_camera{ExpSo3<double>({0.3, -0.2, 0.5}), {0.2, 0.1, 0.4}};
  const BodyPose moved = Moved(bent, moved_from_camera);
  const auto expect_same = [&](const Term& term, const Term& moved_term, double tolerance) {
    const double energy = Energy(term, bent);
    ASSERT_GT(energy, 0.1);
    EXPECT_NEAR(Energy(moved_term, moved), energy, tolerance * energy);
  };
  for (const Term& term : JointTerms()) expect_same(term, term, 1e-9);
  expect_same(Axis(), Axis(), 1e-9);
  expect_same(Prior(), Prior(), 1e-9);
  expect_same(Limit(0.0), Limit(0.0), 1e-9);
  // The pelvis turns against the camera, all other bones against each other.
  LocalRotations moved_previous = previous;
  moved_previous[0] = moved_from_camera.rotation * previous[0];
  expect_same(Inertia(previous), Inertia(moved_previous), 1e-9);
  const FitData pairs = Pairs(bent, 7, 0.02);
  FitData moved_pairs = pairs;
  for (Pair& pair : moved_pairs.pairs) {
    pair.target = (moved_from_camera * pair.target.cast<double>().eval()).cast<float>();
  }
  const double rounding = 1e-5;  // of targets
  expect_same(FitPoints(pairs), FitPoints(moved_pairs), rounding);
  expect_same(FitPlanes(pairs), FitPlanes(moved_pairs), rounding);
}

// Depths are the camera's: what leaves them as they are is a roll about the optical axis.
TEST_F(Terms, DepthRowsAreInvariantUnderARollOfEverything) {
  ASSERT_EQ(camera.fx, camera.fy);
  const BodyPose rolled = Moved(bent, Rigidd{ExpSo3<double>({0.0, 0.0, 0.7}), Vector3d::Zero()});
  const FitData data = Depths(bent, 5, 0.02);
  for (const Term& term : {FitPoints(data), FitPlanes(data)}) {
    const double energy = Energy(term, bent);
    ASSERT_GT(energy, 0.1);
    EXPECT_NEAR(Energy(term, rolled), energy, 1e-9 * energy);
  }
}

}  // namespace
}  // namespace vitruvia::realtime_scape
