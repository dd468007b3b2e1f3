// The rows of the energy against central differences, and where it is at rest.
#include "methods/capsule_icp/capsule_term.h"

#include <gtest/gtest.h>

#include "fitting/state_step.h"
#include "math/rigid.h"
#include "support/body_states.h"
#include "synth/bodies/body_source.h"

namespace vitruvia::capsule_icp {
namespace {

using articulated::kParameterCount;
using Parameters = Eigen::VectorXd;

struct Solved {
  Parameters step;
  double energy;
};

class CapsuleTermTest : public testing::Test {
 protected:
  CapsuleTermTest() : shaped_(RigidShape(body_, 2000)) {
    settings_.common.stride_px = 1;
    settings_.match.facing_cosine = 0.0;
  }

  // What a camera sees of the capsules themselves.
  DepthImage Depth(const BodyState& state, int corners = 64) const {
    const CapsuleMesh mesh = Meshed(FitCapsules(body_, settings_.capsules.trunk_capsules), corners);
    const BoneTransforms bones = WorldFromRest(shaped_, state);
    std::vector<Vector3f> vertices;
    for (std::size_t v = 0; v < mesh.bones.size(); ++v) {
      vertices.push_back(
          (bones[mesh.bones[v]] * mesh.mesh.vertices[v].cast<double>()).cast<float>());
    }
    const std::unique_ptr<MeshRasterizer> rasterizer =
        MakeRasterizer(Rasterizer::kAllTriangles, camera_);
    return rasterizer->Render(vertices, mesh.mesh.triangles);
  }

  Solved Solve(const DepthImage& depth, const BodyState& state, int threads = 1) const {
    CapsuleTerm term(body_, camera_, settings_);
    PointCloud cloud;
    CloudFromDepth(depth, camera_, settings_.common.stride_px, 10.0f, cloud);
    term.Observe({&depth, &cloud});
    articulated::MovingBones bones(shaped_);
    bones.Set(state);
    bones.Differentiate();
    WorkerTeam team(threads);
    articulated::Clock clock;
    articulated::PoseSystem system;
    term.AddRows(bones, 1.0, team, clock, system);
    system.Reduce(bones.twists());
    Eigen::MatrixXd hessian = system.hessian();
    hessian.diagonal().array() += 100.0;
    return {SolveWithinLimits(hessian, system.gradient(), state.angles_deg, kParameterCount),
            system.energy()};
  }

  const BodyModel body_ = Refine(MakeControlBody(BodySettings{}), {.subdivisions = 1});
  const ShapedBody shaped_;
  const PinholeCamera camera_;
  Settings settings_;
};

TEST_F(CapsuleTermTest, TruthAndCleanDataGiveNoStep) {
  const BodyState truth = RandomState(10.0, 8);
  // Depth differences are those of the mesh that the term renders, distances those of the capsules.
  for (const auto& [kind, corners] :
       {std::pair{DataTermKind::kClosestPoint, 64},
        std::pair{DataTermKind::kDepthDifference, kRenderedCorners}}) {
    settings_.data_term = kind;
    const Parameters step = Solve(Depth(truth, corners), truth).step;
    EXPECT_LT(step.segment<3>(PosedBody::kPosition).norm(), 0.001);
    EXPECT_LT(step.cwiseAbs().maxCoeff(), 0.02);  // rad: the mesh is a polyhedron
  }
}

TEST_F(CapsuleTermTest, AStepGoesTowardsTheTruth) {
  for (const DataTermKind kind : {DataTermKind::kClosestPoint, DataTermKind::kDepthDifference}) {
    settings_.data_term = kind;
    const BodyState truth = FacingState();
    BodyState start = truth;
    start.pelvis_position.z() += 0.02;
    const DepthImage depth = Depth(truth);
    const Solved first = Solve(depth, start);
    EXPECT_NEAR(first.step[PosedBody::kPosition + 2], -0.02, 0.004);
    const Solved second = Solve(depth, Moved(start, first.step));
    EXPECT_LT(second.energy, 0.2 * first.energy);
  }
}

// Of the distance of one point from the capsules, as the state changes.
TEST_F(CapsuleTermTest, ClosestPointRowIsTheDerivative) {
  constexpr double kStep = 1e-4;
  const BodyState state = RandomState(15.0, 9);
  const std::vector<Capsule> capsules = FitCapsules(body_, 2);
  PosedCapsules posed(capsules);
  articulated::MovingBones bones(shaped_);
  bones.Set(state);
  bones.Differentiate();
  posed.Pose(bones.camera_from_rest());
  RandomStream random(10, "points");
  int rows = 0;
  for (int i = 0; i < 400; ++i) {
    const Vector3f x(static_cast<float>(random.Uniform(-0.6, 0.7)),
                     static_cast<float>(random.Uniform(-0.6, 0.8)),
                     static_cast<float>(random.Uniform(2.5, 2.8)));
    const DataRow row = ClosestPointRow(posed, x, Vector3f::Zero(), 0.3f, 0.0f);
    if (row.bone < 0 || row.residual < -0.03f) continue;  // an axis is no smooth place
    ++rows;
    articulated::PoseSystem system;
    system.AddRow(row.bone, row.point.cast<double>(), row.direction.cast<double>(), 1.0, 1.0);
    system.Reduce(bones.twists());
    for (const int k : {0, 1, 4, 5, 8, 13, 16, 26}) {
      const auto distance = [&](double amount) {
        BodyState moved = Moved(state, amount * Parameters::Unit(kParameterCount, k));
        const Capsule& capsule = capsules[posed.FindNearest(x).capsule];
        const Rigidd rest_from_camera = Inverse(WorldFromRest(shaped_, moved)[capsule.bone]);
        return DistanceFrom(capsule, rest_from_camera * x.cast<double>()).distance_m;
      };
      const double expected = (distance(kStep) - distance(-kStep)) / (2.0 * kStep);
      EXPECT_NEAR(system.gradient()[k], expected, 1e-3) << i << ' ' << k;
    }
  }
  EXPECT_GT(rows, 20);
}

// Of observed minus rendered depth, where the observed surface is a slanted plane.
TEST_F(CapsuleTermTest, DepthDifferenceRowIsTheDerivative) {
  constexpr double kStep = 1e-4;
  const Vector3d normal = Vector3d(0.3, -0.2, -1.0).normalized();
  const double offset = normal.dot(Vector3d(0.0, 0.0, 2.7));
  const auto observed = [&](const Eigen::Vector2d& uv) {
    return offset / normal.dot(camera_.Unproject(uv.x(), uv.y(), 1.0));
  };
  const Vector3d x(0.2, -0.3, 2.72);
  const Eigen::Vector2d uv = camera_.Project(x);
  const Eigen::Vector2d slope(
      0.5 * (observed(uv + Eigen::Vector2d::UnitX()) - observed(uv - Eigen::Vector2d::UnitX())),
      0.5 * (observed(uv + Eigen::Vector2d::UnitY()) - observed(uv - Eigen::Vector2d::UnitY())));
  const DataRow row = DepthDifferenceRow(
      camera_, 3, x.cast<float>(), static_cast<float>(observed(uv)), slope.cast<float>(), 0.2f);
  const auto difference = [&](const Vector3d& p) { return observed(camera_.Project(p)) - p.z(); };
  EXPECT_NEAR(row.residual, difference(x), 1e-5);
  for (int k = 0; k < 3; ++k) {
    const Vector3d step = kStep * Vector3d::Unit(k);
    EXPECT_NEAR(row.direction[k], (difference(x + step) - difference(x - step)) / (2.0 * kStep),
                1e-4);
  }
  EXPECT_EQ(DepthDifferenceRow(camera_, 3, x.cast<float>(), 4.0f, {}, 0.2f).bone, -1);
}

// Nothing is observed where the arm is: only the silhouette draws it in.
TEST_F(CapsuleTermTest, TheSilhouetteDrawsInAnArmThatIsNotThere) {
  BodyState lowered = FacingState();
  AnatomicalPose pose = PoseOf(lowered.angles_deg);
  pose.sides_deg[kLeft][kShoulderAbduction] = 75.0;
  lowered.angles_deg = AnglesOf(pose);
  const int abduction = PosedBody::kAngles + int{kMidlineAngleCount} + int{kShoulderAbduction};
  settings_.silhouette.reach_px = 60;
  settings_.free_space.weight = 0.0;
  EXPECT_LT(Solve(Depth(lowered), FacingState()).step[abduction], -0.05);
}

TEST_F(CapsuleTermTest, AnyNumberOfThreadsGivesTheSame) {
  const DepthImage depth = Depth(RandomState(10.0, 11));
  for (const DataTermKind kind : {DataTermKind::kClosestPoint, DataTermKind::kDepthDifference}) {
    settings_.data_term = kind;
    const Solved one = Solve(depth, FacingState(), 1), two = Solve(depth, FacingState(), 2);
    EXPECT_EQ(one.step, two.step);
    EXPECT_EQ(one.energy, two.energy);
  }
}

}  // namespace
}  // namespace vitruvia::capsule_icp
