#include "methods/sdf_parts/parts_term.h"

#include <gtest/gtest.h>

#include "fitting/state_step.h"
#include "math/rigid.h"
#include "support/body_states.h"
#include "synth/bodies/body_source.h"

namespace vitruvia::sdf_parts {
namespace {

using articulated::kParameterCount;
using Parameters = Eigen::VectorXd;

class PartsTermTest : public testing::Test {
 protected:
  PartsTermTest() : shaped_(RigidShape(body_, 2000)) {
    settings_.common.stride_px = 1;
    settings_.field.cell_m = 0.02;
  }

  // What a camera sees of the parts themselves.
  DepthImage Depth(const BodyState& state) const {
    const BoneTransforms bones = WorldFromRest(shaped_, state);
    TriangleMesh all;
    for (const Part& part : CutIntoParts(body_, settings_.field.least_weight)) {
      std::vector<Vector3f> posed;
      for (const Vector3f& v : part.mesh.vertices)
        posed.push_back((bones[part.bone] * v.cast<double>()).cast<float>());
      AppendSurface(posed, part.mesh.triangles, all);
    }
    const std::unique_ptr<MeshRasterizer> rasterizer =
        MakeRasterizer(Rasterizer::kFrontFaces, camera_);
    return rasterizer->Render(all.vertices, all.triangles);
  }

  Parameters Step(const DepthImage& depth, const BodyState& state) const {
    PartsTerm term(body_, camera_, settings_);
    PointCloud cloud;
    CloudFromDepth(depth, camera_, settings_.common.stride_px, 10.0f, cloud);
    term.Observe({&depth, &cloud});
    articulated::MovingBones bones(shaped_);
    bones.Set(state);
    bones.Differentiate();
    WorkerTeam team(1);
    articulated::Clock clock;
    articulated::PoseSystem system;
    term.AddRows(bones, 1.0, team, clock, system);
    system.Reduce(bones.twists());
    Eigen::MatrixXd hessian = system.hessian();
    hessian.diagonal().array() += 100.0;
    return SolveWithinLimits(hessian, system.gradient(), state.angles_deg, kParameterCount);
  }

  static BodyState WithArmLowered(double abduction_deg) {
    BodyState state = FacingState();
    AnatomicalPose pose = PoseOf(state.angles_deg);
    pose.sides_deg[kLeft][kShoulderAbduction] = abduction_deg;
    state.angles_deg = AnglesOf(pose);
    return state;
  }

  static constexpr int kLeftAbduction =
      PosedBody::kAngles + int{kMidlineAngleCount} + int{kShoulderAbduction};

  const BodyModel body_ = Refine(MakeControlBody(BodySettings{}), {.subdivisions = 1});
  const ShapedBody shaped_;
  const PinholeCamera camera_;
  Settings settings_;
};

TEST_F(PartsTermTest, TruthAndCleanDataGiveNoStep) {
  const BodyState truth = RandomState(10.0, 3);
  const Parameters step = Step(Depth(truth), truth);
  EXPECT_LT(step.segment<3>(PosedBody::kPosition).norm(), 0.001);
  EXPECT_LT(step.cwiseAbs().maxCoeff(), 0.02);
}

TEST_F(PartsTermTest, AStepGoesTowardsTheTruth) {
  BodyState start = FacingState();
  start.pelvis_position.z() += 0.01;
  EXPECT_NEAR(Step(Depth(FacingState()), start)[PosedBody::kPosition + 2], -0.01, 0.003);
}

// Model to observation alone draws an arm out of empty space. At DART's weight and a cutoff beyond
// which nothing of the arm lies: the damping of Step() leaves less of what weighs less.
TEST_F(PartsTermTest, ThePredictionIsDrawnBackFromEmptySpace) {
  settings_.observed.weight = 0.0;
  settings_.predicted.weight = 1.0;
  settings_.predicted.cutoff_m = 0.15;
  EXPECT_LT(Step(Depth(WithArmLowered(70.0)), FacingState())[kLeftAbduction], -0.03);
}

// The row of a point against central differences of its distance in the moved part's field.
TEST_F(PartsTermTest, ADistanceRowIsTheDerivative) {
  constexpr double kStep = 2e-4;
  const std::vector<Part> parts = CutIntoParts(body_, 0.3);
  PosedParts posed(parts, 0.02, 0.1);
  const BodyState state = RandomState(15.0, 4);
  articulated::MovingBones bones(shaped_);
  bones.Set(state);
  bones.Differentiate();
  int rows = 0;
  for (const int bone : {3, 6, 9, 12, 15}) {
    // Off the surface, in the middle of a cell.
    const Vector3d rest = body_.skeleton.joints[bone] + Vector3d(0.013, 0.021, 0.083);
    const Vector3f x = (bones.camera_from_rest()[bone] * rest).cast<float>();
    posed.Pose(bones.camera_from_rest());
    const PosedParts::Nearest here = posed.DistanceFrom(bone, x);
    if (here.bone < 0) continue;
    ++rows;
    articulated::PoseSystem system;
    system.AddRow(bone, x.cast<double>(), -here.gradient.cast<double>(), 1.0, 1.0);
    system.Reduce(bones.twists());
    for (const int k : {0, 1, 2, 3, 4, 5, 6, 12, 19, 30}) {
      const auto distance = [&](double amount) {
        posed.Pose(
            WorldFromRest(shaped_, Moved(state, amount * Parameters::Unit(kParameterCount, k))));
        return double{posed.DistanceFrom(bone, x).distance_m};
      };
      EXPECT_NEAR(system.gradient()[k], (distance(kStep) - distance(-kStep)) / (2.0 * kStep), 0.01)
          << bone << ' ' << k;
    }
  }
  EXPECT_GE(rows, 4);
}

TEST_F(PartsTermTest, PartsThatReachIntoEachOtherArePushedApart) {
  settings_.observed.weight = settings_.predicted.weight = 0.0;
  const BodyState hanging = WithArmLowered(-5.0);
  const DepthImage depth = Depth(hanging);
  EXPECT_EQ(Step(depth, hanging).norm(), 0.0);
  settings_.intersection.weight = 1.0;
  EXPECT_GT(Step(depth, hanging)[kLeftAbduction], 0.005);
}

}  // namespace
}  // namespace vitruvia::sdf_parts
