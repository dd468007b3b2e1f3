#include "synth/sensor/time_of_flight.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "planes.h"

namespace vitruvia {
namespace {

DepthImage FlightMeasured(const DepthImage& truth, const PinholeCamera& camera,
                          const TimeOfFlightSettings& settings = {}, std::uint64_t seed = 1) {
  RandomStream random(seed, "test");
  return MeasureByTimeOfFlight(truth, camera, settings, 1, random);
}

// A post 21 columns wide, 2 m away, before a wall of wall_m; 0: before nothing.
DepthImage Post(const PinholeCamera& camera, float wall_m) {
  DepthImage depth(camera.width, camera.height, wall_m);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 40; u <= 60; ++u) depth(u, v) = 2.0f;
  }
  return depth;
}

TEST(TimeOfFlight, FormulaIsAsDocumented) {
  const TimeOfFlightSettings s;
  EXPECT_NEAR(AxialDeviation(s, 1.0, 0.0, 0.0), 0.0013, 1e-12);
  EXPECT_NEAR(AxialDeviation(s, 3.0, 0.0, 0.0), 0.0027, 1e-12);
  EXPECT_NEAR(AxialDeviation(s, 4.0, 45 * kDegree, 0.0), 0.0043 + 0.0008, 1e-12);
  EXPECT_NEAR(AxialDeviation(s, 1.0, 0.0, 60 * kDegree), 0.0013 * 4.0, 1e-12);
}

TEST(TimeOfFlight, DeviationIsTheFormulasAtEveryDepthAndAngle) {
  TimeOfFlightSettings settings;
  settings.rim_power = 0.0;  // the columns that are looked at run from rim to rim
  for (const double z : {0.8, 2.0, 4.0}) {
    for (const double angle : {0.0, 45.0, 70.0}) {
      const DepthImage truth = Plane(kNarrow, z, angle * kDegree);
      const ErrorStatistics errors =
          ErrorsNearCenter(FlightMeasured(truth, kNarrow, settings), truth, kNarrow, 2);
      const double expected = AxialDeviation(settings, z, angle * kDegree, 0.0);
      EXPECT_EQ(errors.lost, 0);
      EXPECT_NEAR(errors.deviation_m, expected,
                  4 * expected / std::sqrt(2.0 * errors.count) + 0.02 * expected)
          << z << " m, " << angle << " degrees";
      EXPECT_NEAR(errors.mean_m, 0.0, 4 * expected / std::sqrt(errors.count));
    }
  }
}

TEST(TimeOfFlight, FlyingPixelsLieBetweenTheSurfacesThatMeet) {
  TimeOfFlightSettings settings;
  settings.flying_share = 0.5;
  settings.flying_reach_m = 0.3;
  const DepthImage measured = FlightMeasured(Post(kNarrow, 2.2f), kNarrow, settings);
  int between = 0;
  for (int v = 0; v < kNarrow.height; ++v) {
    for (const int u : {39, 40, 60, 61}) {
      const float z = measured(u, v);
      ASSERT_GT(z, 1.98f);
      ASSERT_LT(z, 2.22f);
      between += z > 2.02f && z < 2.18f ? 1 : 0;
    }
    ASSERT_NEAR(measured(50, v), 2.0, 0.02);
    ASSERT_NEAR(measured(30, v), 2.2, 0.02);
  }
  // Half of the pixels mix the two depths evenly; 0.16 of the 0.20 m between count.
  const double count = 4.0 * kNarrow.height, expected = 0.5 * 0.8;
  EXPECT_NEAR(between / count, expected, 4 * std::sqrt(expected * 0.6 / count));
}

TEST(TimeOfFlight, FlyingPixelsTrailBehindASurfaceBeforeNothing) {
  TimeOfFlightSettings settings;
  settings.flying_share = 1.0;
  settings.flying_reach_m = 0.3;
  const DepthImage measured = FlightMeasured(Post(kNarrow, 0.0f), kNarrow, settings);
  double sum = 0.0;
  for (int v = 0; v < kNarrow.height; ++v) {
    ASSERT_GT(measured(39, v), 1.98f);
    ASSERT_LT(measured(39, v), 2.32f);
    ASSERT_EQ(measured(37, v), 0.0f);
    sum += measured(39, v);
  }
  EXPECT_NEAR(sum / kNarrow.height, 2.15, 4 * 0.3 / std::sqrt(12.0 * kNarrow.height));
  settings.flying_share = 0.0;
  EXPECT_EQ(FlightMeasured(Post(kNarrow, 0.0f), kNarrow, settings)(39, 200), 0.0f);
}

TEST(TimeOfFlight, MeasuresNothingOutOfRangeOrAtGrazingAngles) {
  for (const float z : {0.0f, 0.4f, 8.5f}) {
    const DepthImage depth = FlightMeasured(DepthImage(101, 401, z), kNarrow);
    for (const float d : depth.pixels()) ASSERT_EQ(d, 0.0f) << z;
  }
  EXPECT_EQ(FlightMeasured(Plane(kNarrow, 2.0, 83 * kDegree), kNarrow)(50, 200), 0.0f);
}

TEST(TimeOfFlight, SeedDecidesAndNothingElse) {
  const DepthImage truth = Plane(kNarrow, 2.0, 0.3);
  EXPECT_EQ(FlightMeasured(truth, kNarrow, {}, 5).pixels(),
            FlightMeasured(truth, kNarrow, {}, 5).pixels());
  EXPECT_NE(FlightMeasured(truth, kNarrow, {}, 5).pixels(),
            FlightMeasured(truth, kNarrow, {}, 6).pixels());
}

}  // namespace
}  // namespace vitruvia
