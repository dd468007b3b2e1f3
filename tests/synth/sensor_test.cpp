#include "synth/sensor/sensor.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "config/json_settings.h"
#include "core/error.h"

namespace vitruvia {
namespace {

// Depth of 2 m with an empty left half.
DepthImage HalfAWall() {
  DepthImage depth(320, 240);
  for (int v = 0; v < 240; ++v) {
    for (int u = 160; u < 320; ++u) depth(u, v) = 2.0f;
  }
  return depth;
}

DepthImage MeasuredWith(const SensorSettings& settings, std::uint64_t seed = 1) {
  RandomStream random(seed, "sensor");
  return Measure(HalfAWall(), PinholeCamera{}, settings, random);
}

TEST(Sensor, IdealSeesTheTruth) { EXPECT_EQ(MeasuredWith({}).pixels(), HalfAWall().pixels()); }

TEST(Sensor, GaussianHasItsDeviationAndShareOfDropout) {
  const DepthImage depth =
      MeasuredWith({.model = SensorModel::kGaussian, .sigma_m = 0.004, .dropout = 0.1});
  double sum = 0.0, squares = 0.0;
  int kept = 0;
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u) {
      if (u < 160) {
        ASSERT_EQ(depth(u, v), 0.0f) << "noise must not make measurements out of nothing";
      } else if (depth(u, v) > 0.0f) {
        const double error = depth(u, v) - 2.0;
        sum += error;
        squares += error * error;
        ++kept;
      }
    }
  }
  const double count = 160 * 240;
  EXPECT_NEAR(kept / count, 0.9, 4 * std::sqrt(0.09 / count));
  EXPECT_NEAR(sum / kept, 0.0, 4 * 0.004 / std::sqrt(kept));
  EXPECT_NEAR(std::sqrt(squares / kept), 0.004, 4 * 0.004 / std::sqrt(2.0 * kept));
}

TEST(Sensor, DropoutDoesNotShiftTheNoise) {
  const DepthImage all = MeasuredWith({.model = SensorModel::kGaussian, .sigma_m = 0.004});
  const DepthImage some =
      MeasuredWith({.model = SensorModel::kGaussian, .sigma_m = 0.004, .dropout = 0.5});
  for (std::size_t i = 0; i < all.pixels().size(); ++i) {
    if (some.pixels()[i] == 0.0f) continue;
    ASSERT_EQ(some.pixels()[i], all.pixels()[i]);
  }
}

TEST(Sensor, SeedDecidesAndNothingElse) {
  const SensorSettings settings{.model = SensorModel::kGaussian, .sigma_m = 0.004, .dropout = 0.1};
  EXPECT_EQ(MeasuredWith(settings, 5).pixels(), MeasuredWith(settings, 5).pixels());
  EXPECT_NE(MeasuredWith(settings, 5).pixels(), MeasuredWith(settings, 6).pixels());
}

TEST(Sensor, NeverMeasuresBehindTheCamera) {
  DepthImage near(200, 200, 0.01f);
  RandomStream random(1, "sensor");
  const DepthImage depth = Measure(near, {.width = 200, .height = 200},
                                   {.model = SensorModel::kGaussian, .sigma_m = 0.5}, random);
  for (const float d : depth.pixels()) ASSERT_GE(d, 0.0f);
}

TEST(Sensor, NoiseIsNoSettingOfTheIdealOne) {
  const auto read = [](const char* text) {
    return ReadSettings<SensorSettings>(Json::parse(text), {"scene.json", "sensor"});
  };
  EXPECT_EQ(read(R"({"model": "gaussian", "sigma_m": 0.01})").sigma_m, 0.01);
  EXPECT_THROW(read(R"({"sigma_m": 0.01})"), ConfigError);
  EXPECT_THROW(read(R"({"model": "gaussian", "dropout": 1.5})"), ConfigError);
}

TEST(Sensor, TheSettingsOfOneModelAreNoneOfAnother) {
  const auto read = [](const char* text) {
    return ReadSettings<SensorSettings>(Json::parse(text), {"scene.json", "sensor"});
  };
  EXPECT_EQ(read(R"({"model": "kinect_v1", "kinect_v1": {"edge_loss": 0.1}})").kinect_v1.edge_loss,
            0.1);
  EXPECT_THROW(read(R"({"model": "kinect_one", "kinect_v1": {"edge_loss": 0.1}})"), ConfigError);
  EXPECT_THROW(read(R"({"model": "kinect_v1", "sigma_m": 0.01})"), ConfigError);
}

TEST(FrameDelivery, LosesTheGapAndNothingElse) {
  const std::vector<bool> lost = LostFrames({.gap_start = 3, .gap_length = 2}, 8, 1);
  EXPECT_EQ(lost, (std::vector<bool>{false, false, false, true, true, false, false, false}));
  EXPECT_EQ(LostFrames({.gap_start = 0, .gap_length = 3}, 3, 1),
            (std::vector<bool>{false, true, true}))
      << "a tracker must be given a beginning";
}

TEST(FrameDelivery, LosesItsShareInRunsOfItsLength) {
  const DeliverySettings settings{.drop_share = 0.02, .drop_length = 5};
  const int frames = 50000;
  const std::vector<bool> lost = LostFrames(settings, frames, 1);
  const double share = static_cast<double>(std::count(lost.begin(), lost.end(), true)) / frames;
  // A frame survives if no loss began in it or in the four before it.
  EXPECT_NEAR(share, 1.0 - std::pow(0.98, 5), 0.01);
  int shortest = frames;
  for (int i = 1, run = 0; i < frames; ++i) {
    run = lost[i] ? run + 1 : 0;
    if (lost[i] && i + 1 < frames && !lost[i + 1]) shortest = std::min(shortest, run);
  }
  EXPECT_EQ(shortest, 5);
  EXPECT_EQ(lost, LostFrames(settings, frames, 1));
  EXPECT_NE(lost, LostFrames(settings, frames, 2));
}

TEST(FrameDelivery, ShowsThePastButNothingBeforeTheBeginning) {
  EXPECT_DOUBLE_EQ(CaptureTime({.latency_s = 0.06}, 1.0), 0.94);
  EXPECT_EQ(CaptureTime({.latency_s = 0.06}, 0.03), 0.0);
  EXPECT_EQ(CaptureTime({}, 0.1), 0.1);
}

}  // namespace
}  // namespace vitruvia
