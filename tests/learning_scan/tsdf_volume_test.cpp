#include "learning/scan/tsdf_volume.h"

#include <cmath>

#include <gtest/gtest.h>

#include "learning/scan/scan_surface.h"
#include "learning_scan/analytic_views.h"
#include "learning_scan/scalar_raycast.h"
#include "math/rigid.h"

namespace vitruvia {
namespace {

void Fuse(TsdfVolume& volume, const DepthImage& depth, const PinholeCamera& camera,
          const Rigidd& camera_from_subject, int threads = 1) {
  volume.Integrate(depth, MakePointMap(depth, depth, camera, 0.05, Team(threads)), camera,
                   Inverse(camera_from_subject), Team(threads));
}

// A ball of radius 0.2 m seen from `views` sides and half from above.
TsdfVolume BallFromAllSides(int views, int threads = 1) {
  TsdfVolume volume(SmallVolume(0.3, 0.01, 0.04));
  for (int i = 0; i < views; ++i) {
    const double angle = 2.0 * M_PI * i / views;
    for (const double height : {-0.7, 0.1, 0.7}) {
      const Rigidd camera =
          CameraLookingAt({0.8 * std::sin(angle), height, 0.8 * std::cos(angle)}, {0, 0, 0});
      Fuse(volume, ViewOf({{{0, 0, 0}, 0.2}}, SmallCamera(), camera), SmallCamera(), camera,
           threads);
    }
  }
  return volume;
}

TEST(TsdfVolume, HoldsTheDistanceToAPlane) {
  TsdfVolume volume(SmallVolume(0.25, 0.01, 0.04));
  const Rigidd camera = CameraLookingAt({0.3, 0.1, 0.9}, {0, 0, 0});
  Fuse(volume, ViewOfPlane(SmallCamera(), camera), SmallCamera(), camera);
  int compared = 0;
  for (float z = -0.015f; z < 0.035f; z += 0.01f) {
    for (float x = -0.1f; x <= 0.1f; x += 0.05f) {
      float distance_m = 0.0f;
      ASSERT_TRUE(volume.Interpolate(volume.ToLattice({x, 0.02f, z}), distance_m));
      EXPECT_NEAR(distance_m, z, 1e-4f) << x;
      ++compared;
    }
  }
  EXPECT_GE(compared, 20);
}

TEST(TsdfVolume, KnowsNothingBehindTheSurfaceOrWhereNobodyLooked) {
  TsdfVolume volume(SmallVolume(0.25, 0.01, 0.04));
  float distance_m = 0.0f;
  EXPECT_FALSE(volume.Interpolate(volume.ToLattice({0, 0, 0}), distance_m));
  const Rigidd camera = CameraLookingAt({0, 0, 0.9}, {0, 0, 0});
  Fuse(volume, ViewOfPlane(SmallCamera(), camera), SmallCamera(), camera);
  EXPECT_TRUE(volume.Interpolate(volume.ToLattice({0, 0, 0}), distance_m));
  EXPECT_FALSE(volume.Interpolate(volume.ToLattice({0, 0, -0.06f}), distance_m));
  EXPECT_EQ(volume.At({-5, 0, 0}).weight, 0.0f) << "outside of the scanned space";
  EXPECT_FALSE(volume.Interpolate({-1.0f, 2.0f, 2.0f}, distance_m));
}

TEST(TsdfVolume, AveragesFramesByTheirWeights) {
  // The plane at −5 mm, 0 and +5 mm, all seen at the same angle: the mean is 0.
  TsdfVolume volume(SmallVolume(0.25, 0.01, 0.04));
  for (const double shift : {-0.005, 0.0, 0.005}) {
    Rigidd camera = CameraLookingAt({0, 0, 0.9}, {0, 0, 0});
    DepthImage depth = ViewOfPlane(SmallCamera(), camera);
    for (float& z : depth.pixels()) z -= static_cast<float>(shift);
    Fuse(volume, depth, SmallCamera(), camera);
  }
  float distance_m = 1.0f;
  ASSERT_TRUE(volume.Interpolate(volume.ToLattice({0, 0, 0}), distance_m));
  EXPECT_NEAR(distance_m, 0.0f, 1e-4f);
}

TEST(TsdfVolume, RaycastFindsTheBall) {
  const TsdfVolume volume = BallFromAllSides(12);
  const PinholeCamera camera = SmallCamera();
  const Rigidd subject_from_camera = Inverse(CameraLookingAt({0.5, 0.2, 0.6}, {0, 0, 0}));
  const DepthImage truth = ViewOf({{{0, 0, 0}, 0.2}}, camera, Inverse(subject_from_camera));
  const PointMap map = volume.Raycast(camera, subject_from_camera, Team(2));
  int seen = 0, expected = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      expected += truth(u, v) > 0.0f ? 1 : 0;
      if (!map.Has(u, v)) continue;
      ++seen;
      const Vector3f& point = map.points(u, v);
      EXPECT_NEAR(point.norm(), 0.2f, 1.5e-3f) << u << ", " << v;
      EXPECT_GT(map.normals(u, v).dot(point.normalized()), 0.99f) << u << ", " << v;
      // It lies on its pixel's ray.
      const Vector3d in_camera = Inverse(subject_from_camera) * point.cast<double>().eval();
      const Eigen::Vector2d pixel = camera.Project(in_camera);
      EXPECT_NEAR(pixel.x(), u, 1e-2);
      EXPECT_NEAR(pixel.y(), v, 1e-2);
    }
  }
  EXPECT_GT(seen, 95 * expected / 100);
}

// From sides that were seen and from one that was not, with the image's last tile cut off.
TEST(TsdfVolume, RaycastOfEightRaysEqualsThatOfSingleRays) {
  TsdfVolume volume = BallFromAllSides(3);
  const Rigidd from_side = CameraLookingAt({0.0, 0.1, 0.7}, {0.1, 0.1, 0});
  Fuse(volume,
       ViewOf({{{0.2, 0.15, 0.1}, 0.03}, {{0.2, 0.1, -0.1}, 0.06}}, SmallCamera(), from_side),
       SmallCamera(), from_side);
  PinholeCamera camera = SmallCamera();
  camera.width -= 3;
  int hits = 0;
  for (const Vector3d& place : {Vector3d(0.5, 0.2, 0.6), Vector3d(0.1, 0.9, 0.1),
                                Vector3d(-0.3, -0.1, -0.8), Vector3d(0.0, 0.0, 0.25)}) {
    const Rigidd subject_from_camera = Inverse(CameraLookingAt(place, {0.03, 0.01, 0}));
    const PointMap fast = volume.Raycast(camera, subject_from_camera, Team(2));
    const PointMap simple = ScalarRaycast(volume, camera, subject_from_camera);
    EXPECT_EQ(fast.points.pixels(), simple.points.pixels()) << place.transpose();
    EXPECT_EQ(fast.normals.pixels(), simple.normals.pixels()) << place.transpose();
    for (const Vector3f& normal : fast.normals.pixels()) hits += normal != Vector3f::Zero() ? 1 : 0;
  }
  EXPECT_GT(hits, 10000);
}

TEST(TsdfVolume, SurfaceOfTheBallIsClosedRoundAndFacesOutwards) {
  const TsdfVolume volume = BallFromAllSides(12);
  const ScanSurface surface = Cleaned(ExtractSurface(volume, 0.5), 0.0005, 0.02);
  double sum = 0.0;
  for (const Vector3f& p : surface.mesh.vertices) {
    EXPECT_NEAR(p.norm(), 0.2f, 3e-3f);
    sum += p.norm() - 0.2;
  }
  EXPECT_NEAR(sum / static_cast<double>(surface.mesh.vertices.size()), 0.0, 5e-4);
  EXPECT_EQ(InspectMesh(surface.mesh).problem, "");
  EXPECT_EQ(InspectMesh(surface.mesh).euler_characteristic, 2);
  EXPECT_NEAR(EnclosedVolume(surface.mesh), 4.0 / 3.0 * M_PI * 0.008, 4e-4);
  EXPECT_NEAR(SurfaceArea(surface.mesh), 4.0 * M_PI * 0.04, 5e-3);
  EXPECT_TRUE(surface.holes.empty());
  for (const float w : surface.weights) EXPECT_GE(w, 0.5f);
}

TEST(TsdfVolume, OneViewGivesHalfABallWithOneHole) {
  TsdfVolume volume(SmallVolume(0.3, 0.01, 0.04));
  const Rigidd camera = CameraLookingAt({0, 0, 1.0}, {0, 0, 0});
  Fuse(volume, ViewOf({{{0, 0, 0}, 0.2}}, SmallCamera(), camera), SmallCamera(), camera);
  const ScanSurface surface = Cleaned(ExtractSurface(volume, 0.0), 0.0005, 0.02);
  ASSERT_FALSE(surface.mesh.vertices.empty());
  // No closing wall at the borders of what was seen.
  for (const Vector3f& p : surface.mesh.vertices) EXPECT_NEAR(p.norm(), 0.2f, 6e-3f);
  ASSERT_FALSE(surface.holes.empty());
  EXPECT_GT(surface.holes.front().perimeter_m, 0.9);
  EXPECT_NEAR(surface.holes.front().center.x(), 0.0f, 0.02f);
}

TEST(TsdfVolume, SameForAnyNumberOfThreads) {
  const RawSurface one = ExtractSurface(BallFromAllSides(4, 1), 0.0);
  const RawSurface three = ExtractSurface(BallFromAllSides(4, 3), 0.0);
  EXPECT_EQ(one.mesh.vertices, three.mesh.vertices);
  EXPECT_EQ(one.mesh.triangles, three.mesh.triangles);
  EXPECT_EQ(one.weights, three.weights);
}

TEST(TsdfVolume, RefusesSettingsThatMakeNoSense) {
  EXPECT_EQ(SmallVolume(0.3, 0.01, 0.04).Problem(), "");
  EXPECT_NE(SmallVolume(0.3, 0.01, 0.005).Problem().find("less than a voxel"), std::string::npos);
  EXPECT_NE(SmallVolume(-0.3, 0.01, 0.04).Problem().find("along x"), std::string::npos);
  EXPECT_NE(SmallVolume(9.0, 0.01, 0.04).Problem().find("at most 16 m"), std::string::npos);
  EXPECT_THROW(TsdfVolume(SmallVolume(0.3, 0.01, 0.005)), std::invalid_argument);
}

}  // namespace
}  // namespace vitruvia
