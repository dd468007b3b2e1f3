#include "synth/sensor/expected_noise.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "planes.h"
#include "synth/sensor/shared_noise.h"

namespace vitruvia {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
const PinholeCamera kNarrow{.width = 101, .height = 401, .fx = 580, .fy = 580, .cx = 50, .cy = 200};

// What a sensor measures of slanted planes against what is expected of it.
void ExpectMeasured(const SensorSettings& settings, double z_m, double angle_rad) {
  const DepthImage truth = Plane(kNarrow, z_m, angle_rad);
  RandomStream random(7, "test");
  const DepthImage measured = Measure(truth, kNarrow, settings, random);
  const ErrorStatistics errors = ErrorsNearCenter(measured, truth, kNarrow, 4);
  // Over the same pixels: noise grows towards the image's rim.
  const Image<PixelNoise> noise = ExpectedNoise(truth, kNarrow, settings);
  double variance_m2 = 0.0;
  for (int v = 1; v + 1 < kNarrow.height; ++v) variance_m2 += std::pow(noise(50, v).axial_m, 2);
  const double expected_m = std::sqrt(variance_m2 / (kNarrow.height - 2));
  EXPECT_NEAR(errors.deviation_m / expected_m, 1.0, 0.05);
  const double share = static_cast<double>(errors.count) / (errors.count + errors.lost);
  EXPECT_NEAR(share, noise(50, 200).measured_share, 0.04);
}

TEST(ExpectedNoise, IsThatOfMeasurements) {
  for (const SensorModel model :
       {SensorModel::kGaussian, SensorModel::kKinectV1, SensorModel::kKinectOne}) {
    for (const double angle : {0.0, 50.0}) {
      SensorSettings settings;
      settings.model = model;
      settings.dropout = 0.2;
      settings.depth_unit_m = 1e-5;
      SCOPED_TRACE(testing::Message() << static_cast<int>(model) << ", " << angle);
      ExpectMeasured(settings, 2.5, angle * kDegree);
    }
  }
}

TEST(ExpectedNoise, OfAnIdealSensorIsItsRounding) {
  SensorSettings settings;
  const Image<PixelNoise> noise = ExpectedNoise(Plane(kNarrow, 2.0, 0.0), kNarrow, settings);
  EXPECT_NEAR(noise(50, 200).axial_m, 0.001 / std::sqrt(12.0), 1e-9);
  EXPECT_EQ(noise(50, 200).measured_share, 1.0);
}

TEST(SharedNoise, KeepsTheDeviationAndCountsOnceForEachArea) {
  constexpr int kWidth_px = 5, kSize = 600, kBlock = 60;
  RandomStream random(1, "test");
  Image<double> draws(kSize, kSize);
  for (double& draw : draws.pixels()) draw = random.Normal();
  const Image<double> shared = SharedNoise(draws, kWidth_px);
  double squares = 0.0, squares_of_means = 0.0;
  for (const double value : shared.pixels()) squares += value * value;
  for (int top = 0; top < kSize; top += kBlock) {
    for (int left = 0; left < kSize; left += kBlock) {
      double sum = 0.0;
      for (int v = top; v < top + kBlock; ++v)
        for (int u = left; u < left + kBlock; ++u) sum += shared(u, v);
      squares_of_means += std::pow(sum / (kBlock * kBlock), 2);
    }
  }
  EXPECT_NEAR(squares / (kSize * kSize), 1.0, 0.03);
  const double blocks = std::pow(kSize / kBlock, 2);
  const double expected = kWidth_px * kWidth_px / double{kBlock * kBlock};
  EXPECT_NEAR(squares_of_means / blocks / expected, 1.0, 0.3) << "100 blocks";
  EXPECT_EQ(SharedNoise(draws, 1).pixels(), draws.pixels());
}

TEST(SharedNoise, EntersASensor) {
  SensorSettings settings;
  settings.model = SensorModel::kGaussian;
  settings.shared_px = 9;
  const DepthImage truth = Plane(kNarrow, 2.0, 0.0);
  RandomStream random(2, "test");
  const DepthImage measured = Measure(truth, kNarrow, settings, random);
  double products = 0.0, squares = 0.0;
  for (int v = 0; v < kNarrow.height; ++v) {
    for (int u = 0; u + 1 < kNarrow.width; ++u) {
      const double error = double{measured(u, v)} - 2.0, next = double{measured(u + 1, v)} - 2.0;
      products += error * next;
      squares += error * error;
    }
  }
  EXPECT_NEAR(products / squares, 8.0 / 9.0, 0.05) << "correlation of neighbours";
}

}  // namespace
}  // namespace vitruvia
