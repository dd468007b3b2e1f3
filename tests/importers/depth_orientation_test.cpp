#include "importers/depth_orientation.h"

#include <gtest/gtest.h>

#include "geometry/mesh.h"

namespace vitruvia {
namespace {

const PinholeCamera kStored{64, 48, 60.0, 62.0, 30.25, 25.75};
constexpr float kDepth_m = 2.0f;

// An image with one measured pixel, and where that pixel is after orientation; -1 if it is gone.
struct Found {
  int u = -1, v = -1;
  PinholeCamera camera;
  Vector3d Point() const { return camera.Unproject<double>(u, v, kDepth_m); }
};

Found PlaceOf(int u, int v, const OrientationSettings& settings) {
  DepthImage image(kStored.width, kStored.height);
  image(u, v) = kDepth_m;
  const DepthImage result = Oriented(image, settings);
  Found found;
  found.camera = OrientedCamera(kStored, settings);
  EXPECT_EQ(result.width(), found.camera.width);
  EXPECT_EQ(result.height(), found.camera.height);
  for (int y = 0; y < result.height(); ++y) {
    for (int x = 0; x < result.width(); ++x) {
      if (result(x, y) > 0.0f) found.u = x, found.v = y;
    }
  }
  return found;
}

Vector3d StoredPoint(int u, int v) { return kStored.Unproject<double>(u, v, kDepth_m); }

// The point that a pixel shows is where it was, but for the turn or the mirror.
TEST(Orientation, IntrinsicsFollowCropMirrorAndTurn) {
  const Vector3d p = StoredPoint(20, 30);
  OrientationSettings s;
  EXPECT_TRUE(PlaceOf(20, 30, s).Point().isApprox(p));
  s.crop = {10, 5, 40, 30};
  EXPECT_TRUE(PlaceOf(20, 30, s).Point().isApprox(p));
  EXPECT_EQ(PlaceOf(5, 30, s).u, -1);
  s.mirror = Mirror::kLeftRight;
  EXPECT_TRUE(PlaceOf(20, 30, s).Point().isApprox(Vector3d(-p.x(), p.y(), p.z())));
  s.mirror = Mirror::kUpDown;
  EXPECT_TRUE(PlaceOf(20, 30, s).Point().isApprox(Vector3d(p.x(), -p.y(), p.z())));
  s.mirror = Mirror::kNone;
  s.turn = Turn::kClockwise90;  // what was right is now below
  EXPECT_TRUE(PlaceOf(20, 30, s).Point().isApprox(Vector3d(-p.y(), p.x(), p.z())));
  s.turn = Turn::kHalf;
  EXPECT_TRUE(PlaceOf(20, 30, s).Point().isApprox(Vector3d(-p.x(), -p.y(), p.z())));
  s.turn = Turn::kCounterclockwise90;
  EXPECT_TRUE(PlaceOf(20, 30, s).Point().isApprox(Vector3d(p.y(), -p.x(), p.z())));
}

// A slanted plane stays the same plane at any size.
TEST(Orientation, ResizedDepthLiesOnTheSamePlane) {
  const Vector3d normal = Vector3d(0.3, 0.2, -1.0).normalized();
  DepthImage image(kStored.width, kStored.height);
  for (int v = 0; v < kStored.height; ++v) {
    for (int u = 0; u < kStored.width; ++u)
      image(u, v) = static_cast<float>(-2.0 / normal.dot(kStored.Unproject<double>(u, v, 1.0)));
  }
  for (const auto& [width, height] : {std::pair{32, 24}, std::pair{40, 48}, std::pair{100, 75}}) {
    OrientationSettings s;
    s.resize = {width, height, 0.1};
    const DepthImage result = Oriented(image, s);
    const PinholeCamera camera = OrientedCamera(kStored, s);
    for (int v = 2; v < height - 2; ++v) {
      for (int u = 2; u < width - 2; ++u) {
        const Vector3d p = camera.Unproject<double>(u, v, result(u, v));
        ASSERT_NEAR(normal.dot(p), -2.0, 2e-3) << width << " " << u << " " << v;
      }
    }
  }
}

TEST(Orientation, ResizingDoesNotBridgeAnEdge) {
  DepthImage image(kStored.width, kStored.height, 1.0f);
  for (int v = 0; v < kStored.height; ++v) {
    for (int u = 31; u < kStored.width; ++u) image(u, v) = 3.0f;
  }
  OrientationSettings s;
  s.resize = {32, 24, 0.03};
  const DepthImage resized = Oriented(image, s);
  for (const float z : resized.pixels()) EXPECT_TRUE(z == 1.0f || z == 3.0f) << z;
}

TEST(Orientation, CropOutsideTheImageIsRefused) {
  EXPECT_EQ(CropProblem({0, 0, 64, 48}, 64, 48), "");
  EXPECT_EQ(CropProblem({}, 64, 48), "");
  EXPECT_NE(CropProblem({60, 0, 5, 0}, 64, 48), "");
  EXPECT_NE(CropProblem({0, 48, 0, 0}, 64, 48), "");
}

}  // namespace
}  // namespace vitruvia
