#include "learning/scan/alignment.h"

#include <cmath>

#include <gtest/gtest.h>

#include "learning_scan/analytic_views.h"
#include "math/angles.h"
#include "math/rigid.h"
#include "math/rotation.h"

namespace vitruvia {
namespace {

const Vector3d kCenter(0.02, 0.01, 0.0);

ModelView ExactModel(const Rigidd& camera_from_subject) {
  const PinholeCamera camera = SmallCamera();
  const DepthImage depth = ViewOf(Cluster(), camera, camera_from_subject);
  PointMap map = MakePointMap(depth, depth, camera, 0.05, Team(1));
  const Rigidf subject_from_camera = Inverse(camera_from_subject).Cast<float>();
  for (Vector3f& p : map.points.pixels()) p = subject_from_camera * p;
  for (Vector3f& n : map.normals.pixels()) n = subject_from_camera.rotation * n;
  return {map, camera, camera_from_subject};
}

std::vector<PointMap> FramePyramid(const Rigidd& camera_from_subject, int levels) {
  PinholeCamera camera = SmallCamera();
  DepthImage depth = ViewOf(Cluster(), camera, camera_from_subject);
  std::vector<PointMap> pyramid;
  for (int level = 0; level < levels; ++level) {
    pyramid.push_back(MakePointMap(depth, depth, camera, 0.05, Team(1)));
    depth = Halved(depth, 0.05);
    camera = Halved(camera);
  }
  return pyramid;
}

const Rigidd kFirstView = CameraLookingAt({0.1, 0.1, 0.9}, {0, 0, 0});
const Rigidd kSecondView = CameraLookingAt({0.13, 0.08, 0.89}, {0.005, 0.0, 0.0});

TEST(Alignment, FindsAKnownMotion) {
  AlignmentSettings settings;
  settings.iterations = {20, 5, 5};
  const AlignmentResult result = Align(FramePyramid(kSecondView, 3), ExactModel(kFirstView),
                                       Inverse(kFirstView), kCenter, settings, Team(2));
  const Rigidd error = kSecondView * result.subject_from_camera;
  EXPECT_LT(LogSo3<double>(error.rotation).norm(), 0.1 * kRadiansPerDegree);
  EXPECT_LT(error.translation.norm(), 1.5e-3);
  EXPECT_GT(result.matched_share, 0.8);
  EXPECT_LT(result.rms_m, 2e-3);
  EXPECT_LT(result.condition, 1e3);
  EXPECT_GT(result.iterations, 3);
}

TEST(Alignment, StaysWhereItIsRight) {
  AlignmentSettings settings;
  settings.iterations = {5};
  const AlignmentResult result = Align(FramePyramid(kFirstView, 1), ExactModel(kFirstView),
                                       Inverse(kFirstView), kCenter, settings, Team(1));
  const Rigidd moved = kFirstView * result.subject_from_camera;
  EXPECT_LT(moved.translation.norm(), 1e-5);
  EXPECT_LT(LogSo3<double>(moved.rotation).norm(), 1e-5);
  EXPECT_EQ(result.iterations, 1);
  EXPECT_LT(result.rms_m, 1e-6);
}

// With the pairs held, the squared error after a small step is the quadratic that the system says:
// its gradient 2 b and its curvature 2 A against differences of an independent evaluation.
TEST(Alignment, SystemAgreesWithDifferences) {
  const ModelView model = ExactModel(kFirstView);
  const PointMap frame = FramePyramid(kSecondView, 1).front();
  const Rigidd pose = Inverse(kFirstView);
  AlignmentSettings settings;
  const PointToPlaneSystem system =
      MatchPointToPlane(frame, model, pose, kCenter, settings, Team(1));

  struct Pair {
    Vector3d q, m, n;
  };
  std::vector<Pair> pairs;
  for (int v = 0; v < frame.points.height(); ++v) {
    for (int u = 0; u < frame.points.width(); ++u) {
      if (!frame.Has(u, v)) continue;
      const Vector3d q = pose * frame.points(u, v).cast<double>().eval();
      const Eigen::Vector2d pixel = model.camera.Project<double>(model.camera_from_subject * q);
      const int mu = static_cast<int>(std::lround(pixel.x()));
      const int mv = static_cast<int>(std::lround(pixel.y()));
      if (!model.surface.points.Contains(mu, mv) || !model.surface.Has(mu, mv)) continue;
      const Vector3d m = model.surface.points(mu, mv).cast<double>();
      const Vector3d n = model.surface.normals(mu, mv).cast<double>();
      const Vector3d own = pose.rotation * frame.normals(u, v).cast<double>();
      if ((q - m).norm() > settings.max_distance_m ||
          own.dot(n) < std::cos(settings.max_angle_deg * kRadiansPerDegree)) {
        continue;
      }
      pairs.push_back({q, m, n});
    }
  }
  // A pixel more or less where single and double precision round apart.
  ASSERT_NEAR(static_cast<double>(pairs.size()), system.matched, 3.0);

  const auto error = [&](const Vector6d& x) {
    double sum = 0.0;
    for (const Pair& pair : pairs) {
      const Rigidd moved = Stepped({Matrix3<double>::Identity(), pair.q}, x, kCenter);
      const double residual = pair.n.dot(moved.translation - pair.m);
      sum += residual * residual;
    }
    return sum;
  };
  const double h = 1e-4;
  const double scale = system.b.cwiseAbs().maxCoeff();
  for (int i = 0; i < 6; ++i) {
    const Vector6d e = h * Vector6d::Unit(i);
    const double gradient = (error(e) - error(-e)) / (2.0 * h);
    EXPECT_NEAR(gradient, 2.0 * system.b[i], 2e-2 * scale) << "coordinate " << i;
  }
  for (int i = 3; i < 6; ++i) {  // exact for translations; rotations add second-order terms
    for (int j = 3; j < 6; ++j) {
      const Vector6d a = h * Vector6d::Unit(i), b = h * Vector6d::Unit(j);
      const double curvature =
          (error(a + b) - error(a - b) - error(b - a) + error(-a - b)) / (4.0 * h * h);
      EXPECT_NEAR(curvature, 2.0 * system.a(i, j), 2e-2 * system.a(3, 3)) << i << ", " << j;
    }
  }
}

TEST(Alignment, PlaneLeavesThreeDirectionsOpen) {
  const PinholeCamera camera = SmallCamera();
  const DepthImage depth = ViewOfPlane(camera, kFirstView);
  const PointMap frame = MakePointMap(depth, depth, camera, 0.05, Team(1));
  ModelView model{frame, camera, kFirstView};
  const Rigidf subject_from_camera = Inverse(kFirstView).Cast<float>();
  for (Vector3f& p : model.surface.points.pixels()) p = subject_from_camera * p;
  for (Vector3f& n : model.surface.normals.pixels()) n = subject_from_camera.rotation * n;
  AlignmentSettings settings;
  settings.iterations = {3};
  const AlignmentResult result =
      Align({frame}, model, Inverse(kFirstView), kCenter, settings, Team(1));
  EXPECT_GT(result.condition, 1e6);
}

TEST(Alignment, SystemIsTheSameForAnyNumberOfThreads) {
  const ModelView model = ExactModel(kFirstView);
  const PointMap frame = FramePyramid(kSecondView, 1).front();
  const auto one = MatchPointToPlane(frame, model, Inverse(kFirstView), kCenter, {}, Team(1));
  const auto five = MatchPointToPlane(frame, model, Inverse(kFirstView), kCenter, {}, Team(5));
  EXPECT_EQ(one.a, five.a);
  EXPECT_EQ(one.b, five.b);
  EXPECT_EQ(one.squared_error_m2, five.squared_error_m2);
  EXPECT_EQ(one.matched, five.matched);
}

}  // namespace
}  // namespace vitruvia
