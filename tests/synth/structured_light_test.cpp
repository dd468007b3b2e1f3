#include "synth/sensor/structured_light.h"

#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "planes.h"
#include "synth/sensor/surface_angle.h"

namespace vitruvia {
namespace {

DepthImage LightMeasured(const DepthImage& truth, const PinholeCamera& camera,
                         const StructuredLightSettings& settings = {}, std::uint64_t seed = 1) {
  RandomStream random(seed, "test");
  return MeasureByStructuredLight(truth, camera, settings, 1, random);
}

TEST(SurfaceAngle, IsThatOfAPlane) {
  for (const double angle : {0.0, 30.0, 60.0, 75.0}) {
    const Image<float> angles = IncidenceAngles(Plane(kNarrow, 2.0, angle * kDegree), kNarrow);
    EXPECT_NEAR(angles(50, 200), angle * kDegree, 2e-3) << angle;
  }
}

TEST(SurfaceAngle, DoesNotReachAcrossAnEdge) {
  DepthImage step(8, 8, 2.0f);
  for (int v = 0; v < 8; ++v) {
    for (int u = 4; u < 8; ++u) step(u, v) = 3.0f;
  }
  const PinholeCamera camera{.width = 8, .height = 8, .fx = 500, .fy = 500, .cx = 3.5, .cy = 3.5};
  const Image<float> angles = IncidenceAngles(step, camera);
  EXPECT_NEAR(angles(3, 4), 0.0, 2e-3);
  EXPECT_NEAR(angles(4, 4), 0.0, 2e-3);
  EXPECT_TRUE(IsAtEdge(step, 3, 4));
  EXPECT_TRUE(IsAtEdge(step, 4, 4));
  EXPECT_FALSE(IsAtEdge(step, 2, 4));
  EXPECT_FALSE(IsAtEdge(step, 0, 0)) << "the image's border is no edge of a surface";
}

TEST(StructuredLight, FormulasAreThePublishedOnes) {
  const StructuredLightSettings s;
  EXPECT_NEAR(AxialDeviation(s, 2.4, 0.0), 0.0012 + 0.0019 * 4.0, 1e-12);
  // At 45 degrees θ equals π/2 − θ.
  EXPECT_NEAR(AxialDeviation(s, 4.0, 45 * kDegree), 0.0012 + 0.0019 * 12.96 + 0.00005, 1e-12);
  EXPECT_NEAR(LateralDeviationPx(s, 0.0), 0.8, 1e-12);
  EXPECT_NEAR(LateralDeviationPx(s, 45 * kDegree), 0.835, 1e-12);
  EXPECT_NEAR(DepthStep(s, 3.0), 0.0259, 1e-4);
}

TEST(StructuredLight, DepthComesInStepsOfDisparity) {
  const StructuredLightSettings s;
  std::set<double> depths;
  for (double z = 2.95; z <= 3.05; z += 1e-4) {
    const double quantized = QuantizedDepth(s, z);
    EXPECT_NEAR(quantized, z, 0.51 * DepthStep(s, z));
    const double steps = 580.0 * 0.075 / quantized / 0.125;
    EXPECT_NEAR(steps, std::round(steps), 1e-9);
    depths.insert(quantized);
  }
  EXPECT_NEAR(static_cast<double>(depths.size()), 0.1 / 0.0259, 1.5);
  EXPECT_EQ(QuantizedDepth(s, 1e6), 0.0) << "no disparity is left";
  EXPECT_EQ(QuantizedDepth(s, -0.1), 0.0);
}

// The published deviation is of what the camera delivers, so steps and noise together must make it.
TEST(StructuredLight, DeviationIsThePublishedOneAtEveryDepthAndAngle) {
  for (const double z : {0.8, 1.5, 3.0, 5.0}) {
    for (const double angle : {0.0, 45.0, 70.0}) {
      const DepthImage truth = Plane(kNarrow, z, angle * kDegree);
      // Close to the centre, where depth and angle are still those asked for.
      const ErrorStatistics errors =
          ErrorsNearCenter(LightMeasured(truth, kNarrow), truth, kNarrow, 2);
      const double expected = AxialDeviation({}, z, angle * kDegree);
      EXPECT_EQ(errors.lost, 0);
      const double sampling = expected / std::sqrt(2.0 * errors.count);
      EXPECT_NEAR(errors.deviation_m, expected, 4 * sampling + 0.04 * expected)
          << z << " m, " << angle << " degrees";
      EXPECT_NEAR(errors.mean_m, 0.0, 4 * expected / std::sqrt(errors.count) + 0.02 * expected);
    }
  }
}

TEST(StructuredLight, EdgesMoveByTheLateralDeviation) {
  // A half plane in the native image: the last measured column of a row is off by N(0, σ).
  DepthImage half(201, 2000);
  for (int v = 0; v < half.height(); ++v) {
    for (int u = 0; u <= 100; ++u) half(u, v) = 2.0f;
  }
  const PinholeCamera camera{
      .width = 201, .height = 2000, .fx = 580, .fy = 580, .cx = 100, .cy = 1000};
  StructuredLightSettings settings;
  settings.edge_loss = 0.0;
  settings.lateral_base_px = 3.0;
  const DepthImage measured = LightMeasured(half, camera, settings);
  // A pixel d columns beyond the edge is measured when its shift reaches back over it.
  for (const int d : {1, 3, 5}) {
    int seen = 0;
    for (int v = 0; v < half.height(); ++v) seen += measured(100 + d, v) > 0.0f ? 1 : 0;
    const double expected = 0.5 * std::erfc((d - 0.5) / 3.0 / std::numbers::sqrt2);
    EXPECT_NEAR(seen / 2000.0, expected, 4 * std::sqrt(expected / 2000.0)) << d;
    int missed = 0;
    for (int v = 0; v < half.height(); ++v) missed += measured(101 - d, v) == 0.0f ? 1 : 0;
    EXPECT_NEAR(missed / 2000.0, expected, 4 * std::sqrt(expected / 2000.0)) << d;
  }
}

TEST(StructuredLight, LosesItsShareOfEdgePixelsAndNoneInside) {
  DepthImage half(200, 2000);
  for (int v = 0; v < half.height(); ++v) {
    for (int u = 0; u < 100; ++u) half(u, v) = 2.0f;
  }
  const PinholeCamera camera{
      .width = 200, .height = 2000, .fx = 580, .fy = 580, .cx = 100, .cy = 1000};
  StructuredLightSettings settings;
  settings.lateral_base_px = settings.lateral_slope_px = 0.0;
  settings.edge_loss = 0.3;
  const DepthImage measured = LightMeasured(half, camera, settings);
  int at_edge = 0, inside = 0;
  for (int v = 0; v < half.height(); ++v) {
    at_edge += measured(99, v) == 0.0f ? 1 : 0;
    inside += measured(60, v) == 0.0f ? 1 : 0;
  }
  EXPECT_NEAR(at_edge / 2000.0, 0.3, 4 * std::sqrt(0.21 / 2000.0));
  EXPECT_EQ(inside, 0);
}

// A board in front of a wall. Its right edge is seen at column e; the projector, b to the right,
// sees the wall only from where its own ray past that edge meets it.
TEST(StructuredLight, ShadowLiesOnTheSideAwayFromTheProjectorAndIsAsWideAsGeometrySays) {
  const PinholeCamera camera{.width = 320, .height = 3, .fx = 285, .fy = 285, .cx = 160, .cy = 1};
  constexpr float kBoard = 1.0f, kWall = 2.0f;
  DepthImage depth(320, 3, kWall);
  for (int v = 0; v < 3; ++v) {
    for (int u = 120; u <= 200; ++u) depth(u, v) = kBoard;
  }
  const MaskImage shadow = ProjectorShadow(depth, camera, {});
  int left = 0, right = 0, board = 0;
  for (int u = 0; u < 320; ++u) {
    if (shadow(u, 1) == 0) continue;
    (u < 120 ? left : u > 200 ? right : board) += 1;
  }
  const double width = 285 * 0.075 * (1 / double{kBoard} - 1 / double{kWall});
  EXPECT_NEAR(left, width, 1.0);
  EXPECT_EQ(right, 0);
  EXPECT_EQ(board, 0);
}

TEST(StructuredLight, ASmoothSurfaceCastsNoShadowOnItself) {
  for (const double angle : {-70.0, 0.0, 70.0}) {
    const MaskImage shadow = ProjectorShadow(Plane(kNarrow, 2.0, angle * kDegree), kNarrow, {});
    for (const auto pixel : shadow.pixels()) ASSERT_EQ(pixel, 0) << angle;
  }
}

TEST(StructuredLight, MeasuresNothingOutOfRangeOrAtGrazingAngles) {
  const auto measured_pixels = [](const DepthImage& truth) {
    const DepthImage measured = LightMeasured(truth, kNarrow);
    int count = 0;
    for (const float z : measured.pixels()) count += z > 0.0f ? 1 : 0;
    return count;
  };
  EXPECT_EQ(measured_pixels(DepthImage(101, 401)), 0);
  EXPECT_EQ(measured_pixels(DepthImage(101, 401, 0.3f)), 0);
  EXPECT_EQ(measured_pixels(DepthImage(101, 401, 9.0f)), 0);
  const DepthImage steep = Plane(kNarrow, 2.0, 85 * kDegree);
  EXPECT_EQ(LightMeasured(steep, kNarrow)(50, 200), 0.0f);
}

TEST(StructuredLight, SeedDecidesAndNothingElse) {
  const DepthImage truth = Plane(kNarrow, 2.0, 0.3);
  EXPECT_EQ(LightMeasured(truth, kNarrow, {}, 5).pixels(),
            LightMeasured(truth, kNarrow, {}, 5).pixels());
  EXPECT_NE(LightMeasured(truth, kNarrow, {}, 5).pixels(),
            LightMeasured(truth, kNarrow, {}, 6).pixels());
}

}  // namespace
}  // namespace vitruvia
