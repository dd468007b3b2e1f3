#include "math/lanes.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace vitruvia {
namespace {

constexpr FloatLanes kNumbers = {-2.5f, -2.0f, -0.0f, 0.25f, 1.0f, 1.75f, 3e5f, -7.0f};

TEST(Lanes, RoundLikeTheStandardLibrary) {
  const FloatLanes floor = Floor(kNumbers), ceil = Ceil(kNumbers);
  const IntLanes truncated = Truncate(kNumbers);
  for (int lane = 0; lane < kLanes; ++lane) {
    EXPECT_EQ(floor[lane], std::floor(kNumbers[lane]));
    EXPECT_EQ(ceil[lane], std::ceil(kNumbers[lane]));
    EXPECT_EQ(truncated[lane], static_cast<int>(kNumbers[lane]));
  }
}

TEST(Lanes, GiveMasksExtremesAndLoads) {
  EXPECT_EQ(Bits(kNumbers < 0.0f), 0b10000011u);
  EXPECT_EQ(Bits(Max(kNumbers, FloatLanes{}) == 0.0f), 0b10000111u);
  EXPECT_EQ(Bits(Min(kNumbers, FloatLanes{}) == 0.0f), 0b01111100u);
  EXPECT_EQ(SmallestLane(kNumbers), -7.0f);
  const std::vector<int> column = {9, 8, 7, 6, 5, 4, 3, 2, 1, 0};
  const auto loaded = LoadLanes<IntLanes>(column, 2);
  for (int lane = 0; lane < kLanes; ++lane) EXPECT_EQ(loaded[lane], 7 - lane);
}

TEST(Lanes, CompressToThoseOfAMask) {
  const IntLanes numbers = CountFrom(10);
  for (unsigned bits = 0; bits < 1u << kLanes; ++bits) {
    IntLanes mask{};
    std::vector<int> expected;
    for (int lane = 0; lane < kLanes; ++lane) {
      if ((bits >> lane & 1u) == 0) continue;
      mask[lane] = -1;
      expected.push_back(10 + lane);
    }
    std::vector<int> compressed(kLanes);
    ASSERT_EQ(Compress(numbers, mask, compressed.data()), expected.size());
    compressed.resize(expected.size());
    EXPECT_EQ(compressed, expected);
  }
}

TEST(Lanes, GatherNumbersByTheirIndices) {
  std::vector<float> numbers(20);
  std::iota(numbers.begin(), numbers.end(), 0.5f);
  const IntLanes indices = {19, 0, 7, 7, 3, 12, 1, 18};
  const FloatLanes gathered = Gather(numbers.data(), indices);
  for (int lane = 0; lane < kLanes; ++lane) EXPECT_EQ(gathered[lane], numbers[indices[lane]]);
  const FloatLanes sizes = Abs(kNumbers);
  for (int lane = 0; lane < kLanes; ++lane) EXPECT_EQ(sizes[lane], std::abs(kNumbers[lane]));
}

TEST(Lanes, GatherTheCoordinatesOfPoints) {
  std::vector<float> xyz(3 * kLanes);
  std::iota(xyz.begin(), xyz.end(), 0.0f);
  const PointLanes points = LoadPoints(xyz.data());
  for (int lane = 0; lane < kLanes; ++lane) {
    EXPECT_EQ(points.x[lane], xyz[3 * lane]);
    EXPECT_EQ(points.y[lane], xyz[3 * lane + 1]);
    EXPECT_EQ(points.z[lane], xyz[3 * lane + 2]);
  }
}

}  // namespace
}  // namespace vitruvia
