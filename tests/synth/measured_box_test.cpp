// Sensors draw noise only where something may be measured; the result must not show it.
#include "synth/sensor/measured_box.h"

#include <array>

#include <gtest/gtest.h>

#include "synth/sensor/sensor.h"

namespace vitruvia {
namespace {

const PinholeCamera kCamera{
    .width = 120, .height = 90, .fx = 580, .fy = 580, .cx = 59.5, .cy = 44.5};

// A square in the middle of the image.
DepthImage Square() {
  DepthImage depth(kCamera.width, kCamera.height);
  for (int v = 38; v < 50; ++v) {
    for (int u = 50; u < 70; ++u) depth(u, v) = 2.0f;
  }
  return depth;
}

std::array<int, 4> Sides(const PixelBox& box) { return {box.left, box.top, box.right, box.bottom}; }

TEST(MeasuredBox, HoldsEveryPixelNearOneWithADepth) {
  EXPECT_EQ(Sides(MeasuredBox(Square(), 0)), (std::array{50, 38, 70, 50}));
  EXPECT_EQ(Sides(MeasuredBox(Square(), 45)), (std::array{5, 0, 115, 90}));
  const PixelBox empty = MeasuredBox(DepthImage(8, 8), 3);
  for (int i = 0; i < 8; ++i) EXPECT_FALSE(empty.Contains(i, i));
  EXPECT_EQ(Sides(MeasuredBox(DepthImage(7, 9), 0)), (std::array{0, 0, 7, 9})) << "odd";
}

TEST(NormalDraws, LeavesOutWithoutAnEffectOnOthers) {
  for (unsigned needed = 0; needed < 256; ++needed) {
    RandomStream all(3, "draws"), some(3, "draws");
    NormalDraws draws(some);
    for (int i = 0; i < 8; ++i) {
      const bool is_needed = (needed >> i & 1) != 0;
      const double expected = all.Normal();
      EXPECT_EQ(draws.Next(is_needed), is_needed ? expected : 0.0) << needed << " at " << i;
      if (i % 3 == 2) {
        EXPECT_EQ(some.Uniform(), all.Uniform()) << needed << " at " << i;
      }
    }
    EXPECT_EQ(some.NextBits(), all.NextBits());
  }
}

// Two pixels in the corners make the box the whole image.
TEST(MeasuredBox, HasNoInfluenceOnTheNoise) {
  const DepthImage square = Square();
  DepthImage with_corners = square;
  with_corners(0, 0) = with_corners(kCamera.width - 1, kCamera.height - 1) = 2.0f;
  for (const SensorModel model : {SensorModel::kKinectV1, SensorModel::kKinectOne}) {
    for (const int shared_px : {1, 5}) {
      SensorSettings settings;
      settings.model = model;
      settings.shared_px = shared_px;
      RandomStream random(1, "sensor"), other_random(1, "sensor");
      for (int frame = 0; frame < 3; ++frame) {
        const DepthImage measured = Measure(square, kCamera, settings, random);
        const DepthImage other = Measure(with_corners, kCamera, settings, other_random);
        int count = 0;
        for (int v = 15; v < kCamera.height - 15; ++v) {
          for (int u = 0; u < kCamera.width; ++u) {
            EXPECT_EQ(measured(u, v), other(u, v)) << u << ", " << v;
            count += measured(u, v) > 0.0f ? 1 : 0;
          }
        }
        EXPECT_GT(count, 180);
      }
    }
  }
}

}  // namespace
}  // namespace vitruvia
