#include "learning/scan/point_map.h"

#include <gtest/gtest.h>

#include "learning_scan/analytic_views.h"
#include "math/rigid.h"

namespace vitruvia {
namespace {

TEST(PointMap, HasThePlanesPointsAndNormals) {
  const PinholeCamera camera = SmallCamera();
  const Rigidd camera_from_subject = CameraLookingAt({0.4, 0.3, 1.2}, {0, 0, 0});
  const Rigidd subject_from_camera = Inverse(camera_from_subject);
  const DepthImage depth = ViewOfPlane(camera, camera_from_subject);
  const PointMap map = MakePointMap(depth, depth, camera, 0.05, Team(2));
  for (int v = 10; v < 110; v += 10) {
    for (int u = 10; u < 150; u += 10) {
      const Vector3d point = subject_from_camera * map.points(u, v).cast<double>().eval();
      EXPECT_NEAR(point.z(), 0.0, 1e-6);
      const Vector3d normal = subject_from_camera.rotation * map.normals(u, v).cast<double>();
      EXPECT_NEAR(normal.z(), 1.0, 1e-5) << "it must face the camera";
    }
  }
}

TEST(PointMap, NormalsDoNotReachAcrossAJump) {
  DepthImage depth(8, 8, 1.0f);
  for (int v = 0; v < 8; ++v) {
    for (int u = 4; u < 8; ++u) depth(u, v) = 2.0f;
  }
  const PinholeCamera camera{8, 8, 10.0, 10.0, 3.5, 3.5};
  const PointMap map = MakePointMap(depth, depth, camera, 0.1, Team(1));
  for (int u = 0; u < 8; ++u) {
    EXPECT_NEAR(map.normals(u, 3).z(), -1.0f, 1e-6f) << "column " << u;
  }
}

TEST(PointMap, LonelyPixelsHaveNoNormal) {
  DepthImage depth(5, 5);
  depth(2, 2) = 1.0f;
  const PointMap map = MakePointMap(depth, depth, {5, 5, 5, 5, 2, 2}, 0.1, Team(1));
  EXPECT_FALSE(map.Has(2, 2));
  EXPECT_FALSE(map.Has(0, 0));
}

TEST(Smoothed, KeepsEvenDepthAndEdgesAndLessensNoise) {
  DepthImage even(20, 20, 1.5f);
  for (int v = 0; v < 20; ++v) {
    for (int u = 10; u < 20; ++u) even(u, v) = 2.5f;
  }
  const SmoothingSettings settings{.sigma_px = 1.5, .sigma_m = 0.02};
  const DepthImage same = Smoothed(even, settings, Team(2));
  for (std::size_t i = 0; i < even.pixels().size(); ++i) {
    EXPECT_NEAR(same.pixels()[i], even.pixels()[i], 1e-6f);
  }
  DepthImage checkered(20, 20);
  for (int v = 0; v < 20; ++v) {
    for (int u = 0; u < 20; ++u) checkered(u, v) = (u + v) % 2 == 0 ? 1.0f : 1.01f;
  }
  const DepthImage calm = Smoothed(checkered, settings, Team(1));
  EXPECT_NEAR(calm(10, 10), 1.005f, 0.001f);
  EXPECT_NEAR(calm(11, 10), 1.005f, 0.001f);
}

TEST(Halved, AveragesWhatIsOneSurface) {
  DepthImage depth(4, 2);
  depth(0, 0) = 1.0f;
  depth(1, 0) = 1.02f;
  depth(0, 1) = 2.0f;  // another surface; (1, 1) is empty
  const DepthImage half = Halved(depth, 0.05);
  EXPECT_EQ(half.width(), 2);
  EXPECT_EQ(half.height(), 1);
  EXPECT_FLOAT_EQ(half(0, 0), 1.01f);
  EXPECT_EQ(half(1, 0), 0.0f);
}

TEST(Halved, CameraSeesTheSamePointBetweenTheSamePixels) {
  const PinholeCamera camera = SmallCamera(), half = Halved(camera);
  const Vector3d point(0.1, -0.2, 1.3);
  const Eigen::Vector2d whole = camera.Project(point), coarse = half.Project(point);
  // The edges of pixel k are k ± ½: edges of the coarse image are every second one of the fine.
  EXPECT_NEAR(2.0 * (coarse.x() + 0.5), whole.x() + 0.5, 1e-12);
  EXPECT_NEAR(2.0 * (coarse.y() + 0.5), whole.y() + 0.5, 1e-12);
}

}  // namespace
}  // namespace vitruvia
