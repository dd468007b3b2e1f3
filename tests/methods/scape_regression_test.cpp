// SCAPE by regression: its surface against the mesh solve, its rows against differences, and frames
// that it must not move away from.
#include "methods/scape_regression/scape_regression.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "geometry/zbuffer.h"
#include "learning/shape/scape_mesh.h"
#include "math/rotation.h"
#include "methods/scape_regression/frame_fit.h"
#include "support/tiny_body.h"

namespace vitruvia::scape_regression {
namespace {

const Rigidd kCameraFromSubject{Vector3d(1, -1, -1).asDiagonal(), {0.05, 0.9, 2.6}};

// A regression with terms of every kind, small and different for all triangles.
PoseRegression SomeRegression(const BodyModel& body, double size) {
  PoseRegression regression =
      LearnPoseRegression(body, {{body.skeleton, body.rest.vertices, {body.rest.vertices}}}, {});
  RandomStream random(8, "terms");
  for (TrianglePoseModel& model : regression.triangles) {
    model.terms[0].setIdentity();
    for (int r = 1; r < kRegressors; ++r) {
      model.terms[r] = Matrix3<float>::NullaryExpr(
          [&](Eigen::Index, Eigen::Index) { return static_cast<float>(random.Normal(0.0, size)); });
    }
  }
  return regression;
}

class ScapeBodyOfATinyBody : public ::testing::Test {
 protected:
  ScapePose SomePose(double deviation = 0.3) const {
    RandomStream random(9, "pose");
    ScapePose pose = scape.RestPose(kCameraFromSubject);
    for (Matrix3<double>& rotation : pose.rotations) {
      rotation = rotation * ExpSo3<double>(Vector3d::NullaryExpr(
                                [&](Eigen::Index) { return random.Normal(0.0, deviation); }));
    }
    return pose;
  }
  std::vector<Vector3f> Surface(const ScapePose& pose) const {
    std::vector<Vector3f> vertices;
    scape.Vertices(pose, vertices);
    return vertices;
  }
  DepthImage Depth(const std::vector<Vector3f>& vertices) {
    return zbuffer.Render(vertices, body.rest.triangles);
  }

  const BodyModel body = TinyBody(3);
  const PoseRegression regression = SomeRegression(body, 0.05);
  const ScapeBody scape{body, regression};
  const PinholeCamera camera{};
  ZBuffer zbuffer{camera};
};

TEST_F(ScapeBodyOfATinyBody, IsTheRestSurfaceInTheRestPose) {
  const std::vector<Vector3f> vertices = Surface(scape.RestPose(kCameraFromSubject));
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const Vector3d expected = kCameraFromSubject * body.rest.vertices[v].cast<double>();
    EXPECT_LT((vertices[v].cast<double>() - expected).norm(), 1e-5);
  }
}

TEST_F(ScapeBodyOfATinyBody, IsTheMeshSolveOfItsTriangles) {
  const ScapePose pose = SomePose();
  const ScapeMesh mesh(body.rest);
  const auto turns = JointRotationVectors(pose.rotations);
  std::vector<Matrix3<double>> turned, q;
  for (const TrianglePoseModel& model : regression.triangles) {
    turned.push_back(pose.rotations[model.bone]);
    q.push_back(DeformationOf(model, turns));
  }
  const std::vector<Vector3d> solved = mesh.Solve(turned, q);
  const std::vector<Vector3f> vertices = Surface(pose);
  for (std::size_t v = 1; v < vertices.size(); ++v) {
    const Vector3d expected = solved[v] - solved[0];
    EXPECT_LT(((vertices[v] - vertices[0]).cast<double>() - expected).norm(), 1e-4);
  }
}

TEST_F(ScapeBodyOfATinyBody, RowsAreTheDerivativesOfTheVertices) {
  const ScapePose pose = SomePose();
  const ScapeBody::Linearization at = ScapeBody::LinearizeAt(pose);
  const Vector3d n = Vector3d(0.3, -0.5, 0.8).normalized();
  constexpr double kStep = 3e-3;  // vertices are of single precision
  for (const int vertex : {0, 40, 111, static_cast<int>(body.rest.vertices.size()) - 1}) {
    const ScapeBody::Row row = scape.RowOf(at, vertex, n);
    for (int k = 0; k < ScapeBody::kParameters; ++k) {
      Eigen::VectorXd step = Eigen::VectorXd::Zero(ScapeBody::kParameters);
      step[k] = kStep;
      const auto along = [&](const Eigen::VectorXd& by) {
        return n.dot(Surface(ScapeBody::Stepped(pose, by))[vertex].cast<double>());
      };
      const double difference = (along(step) - along(-step)) / (2.0 * kStep);
      EXPECT_NEAR(row[k], difference, 3e-4) << "vertex " << vertex << ", parameter " << k;
    }
  }
}

TEST_F(ScapeBodyOfATinyBody, ARigidMotionMovesTheSurfaceRigidly) {
  const ScapePose pose = SomePose();
  const Rigidd motion{ExpSo3<double>({0.2, 0.7, -0.4}), {0.1, 0.2, 0.3}};
  ScapePose moved = pose;
  moved.center = motion * pose.center;
  for (Matrix3<double>& rotation : moved.rotations) rotation = motion.rotation * rotation;
  const std::vector<Vector3f> before = Surface(pose), after = Surface(moved);
  for (std::size_t v = 0; v < before.size(); ++v) {
    const Vector3d expected = motion * before[v].cast<double>();
    EXPECT_LT((after[v].cast<double>() - expected).norm(), 1e-5);
  }
}

// The gradient of the whole energy, pairs kept.
TEST_F(ScapeBodyOfATinyBody, TheGradientIsHalfTheDerivativeOfTheEnergy) {
  Settings settings;
  settings.fit.pose_change_weight = 2.0;
  settings.fit.pose_weight = 0.5;
  const ScapePose pose = SomePose(0.1), last = scape.RestPose(kCameraFromSubject);
  const std::vector<Vector3f> vertices = Surface(pose);
  ScapePose truth = SomePose(0.15);
  truth.center += Vector3d(0.01, -0.01, 0.015);
  const DepthImage depth = Depth(Surface(truth));
  PairFinder finder(body.rest.triangles, vertices.size(), camera, settings);
  const Pairs& pairs = finder.Find(vertices, depth, ObservedContour(depth, 8.0));
  ASSERT_GT(pairs.depth.size(), 100u);
  ASSERT_GT(pairs.model_to_observed.size(), 20u);
  ASSERT_GT(pairs.observed_to_model.size(), 100u);
  const FrameEnergy energy(scape, camera, settings);
  constexpr double kKernel_m = 0.05, kStep = 2e-3;
  const NormalEquations equations = energy.Linearized(pairs, vertices, pose, last, kKernel_m);
  const double scale = equations.gradient.norm();
  for (int k = 0; k < ScapeBody::kParameters; ++k) {
    Eigen::VectorXd step = Eigen::VectorXd::Zero(ScapeBody::kParameters);
    step[k] = kStep;
    const auto at = [&](const Eigen::VectorXd& by) {
      const ScapePose stepped = ScapeBody::Stepped(pose, by);
      return energy.Of(pairs, Surface(stepped), stepped, last, kKernel_m).total();
    };
    const double half_slope = (at(step) - at(-step)) / (4.0 * kStep);
    EXPECT_NEAR(equations.gradient[k], half_slope, 2e-3 * scale) << k;
  }
}

TEST_F(ScapeBodyOfATinyBody, StaysAtTheTruth) {
  Settings settings;
  const ScapePose truth = scape.RestPose(kCameraFromSubject);
  FrameFit fit(scape, camera, settings);
  std::vector<Vector3f> vertices;
  StepClock<TimedStep> clock;
  const FitResult result =
      fit.Fit(Depth(Surface(truth)), truth, truth, settings.fit.iterations, vertices, clock);
  const std::vector<Vector3f> expected = Surface(truth);
  double mean = 0.0;
  for (std::size_t v = 0; v < vertices.size(); ++v)
    mean += (vertices[v] - expected[v]).norm() / static_cast<float>(vertices.size());
  EXPECT_LT(mean, 0.004);  // a pixel is 9 mm
  EXPECT_GT(result.supported, 0.7);
}

TEST_F(ScapeBodyOfATinyBody, FollowsAnArm) {
  ScapePose truth = scape.RestPose(kCameraFromSubject);
  const Matrix3<double> down = ExpSo3<double>({0.0, 0.0, -0.3});
  for (const BoneId bone : {BoneId::kLeftUpperArm, BoneId::kLeftForearm, BoneId::kLeftHand}) {
    Matrix3<double>& rotation = truth.rotations[static_cast<int>(bone)];
    rotation = rotation * down;
  }
  ScapeRegression tracker(Settings{}, regression);
  tracker.Start(body, camera);
  const DepthImage rest = Depth(Surface(scape.RestPose(kCameraFromSubject)));
  tracker.TrackFrame({0, 0.0, rest});
  const std::vector<Vector3f> expected = Surface(truth);
  const TrackResult result = tracker.TrackFrame({1, 0.03, Depth(expected)});
  EXPECT_FALSE(IsFailure(result.outcome));
  double mean = 0.0;
  for (std::size_t v = 0; v < expected.size(); ++v)
    mean += (result.vertices[v] - expected[v]).norm() / static_cast<float>(expected.size());
  EXPECT_LT(mean, 0.01);
}

TEST_F(ScapeBodyOfATinyBody, KeepsThePoseInAnEmptyFrame) {
  ScapeRegression tracker(Settings{}, regression);
  tracker.Start(body, camera);
  const TrackResult first =
      tracker.TrackFrame({0, 0.0, Depth(Surface(scape.RestPose(kCameraFromSubject)))});
  const TrackResult second = tracker.TrackFrame({1, 0.03, DepthImage(camera.width, camera.height)});
  EXPECT_EQ(second.outcome, Outcome::kNoData);
  EXPECT_EQ(second.vertices, first.vertices);
}

}  // namespace
}  // namespace vitruvia::scape_regression
