#include "analysis/paired_comparison.h"

#include <cmath>

#include <gtest/gtest.h>

#include "analysis/pareto_front.h"
#include "core/random.h"

namespace vitruvia {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(SpreadOf, IsMeanAndDeviationWithOneDegreeLess) {
  const std::vector<double> values = {2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0};
  const SampleSpread spread = SpreadOf(values);
  EXPECT_EQ(spread.count, 8);
  EXPECT_EQ(spread.mean, 5.0);
  EXPECT_DOUBLE_EQ(spread.deviation, std::sqrt(32.0 / 7.0));
  EXPECT_TRUE(std::isnan(SpreadOf(std::vector<double>{3.0}).deviation));
  EXPECT_EQ(SpreadOf(std::vector<double>{3.0}).mean, 3.0);
  EXPECT_TRUE(std::isnan(SpreadOf({}).mean));
}

TEST(StudentQuantile, IsTheTables) {
  // Abramowitz & Stegun, table 26.10.
  EXPECT_NEAR(StudentQuantile(0.95, 1), 12.706, 5e-4);
  EXPECT_NEAR(StudentQuantile(0.95, 2), 4.303, 5e-4);
  EXPECT_NEAR(StudentQuantile(0.95, 9), 2.262, 5e-4);
  EXPECT_NEAR(StudentQuantile(0.99, 10), 3.169, 5e-4);
  EXPECT_NEAR(StudentQuantile(0.90, 120), 1.658, 5e-4);
  // Cauchy's distribution in closed form.
  EXPECT_NEAR(StudentQuantile(0.5, 1), 1.0, 1e-12);
}

TEST(BootstrapMeanInterval, OfTwoValuesHasTheEndsOfTheThreePossibleMeans) {
  // Means 0, ½ and 1 with probabilities ¼, ½, ¼: at 50 % the expanded tail is
  // ½ erfc(√2 · 1 / √2) = 7.9 %, which lies in the outer quarters.
  const std::vector<double> values = {0.0, 1.0};
  const Interval interval = BootstrapMeanInterval(values, {.confidence = 0.5});
  EXPECT_EQ(interval.low, 0.0);
  EXPECT_EQ(interval.high, 1.0);
  // At 10 % the tail is ½ erfc(tan 4.5°· √2 / √2) ≈ 45.6 %: in the middle half.
  const Interval narrow = BootstrapMeanInterval(values, {.confidence = 0.1});
  EXPECT_EQ(narrow.low, 0.5);
  EXPECT_EQ(narrow.high, 0.5);
}

TEST(BootstrapMeanInterval, OfEqualValuesIsTheValueAndOfOneIsEverything) {
  const std::vector<double> equal(7, 0.1);
  EXPECT_EQ(BootstrapMeanInterval(equal, {}).low, 0.1);
  EXPECT_EQ(BootstrapMeanInterval(equal, {}).high, 0.1);
  const std::vector<double> one = {0.3};
  EXPECT_EQ(BootstrapMeanInterval(one, {}).low, -kInfinity);
  EXPECT_EQ(BootstrapMeanInterval(one, {}).high, kInfinity);
  EXPECT_THROW(BootstrapMeanInterval({}, {}), std::invalid_argument);
}

TEST(BootstrapMeanInterval, IsTheSameForTheSameSeed) {
  const std::vector<double> values = {0.3, 1.2, -0.4, 0.8, 2.1, 0.9};
  const Interval a = BootstrapMeanInterval(values, {.seed = 5});
  const Interval b = BootstrapMeanInterval(values, {.seed = 5});
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
  EXPECT_NE(a.low, BootstrapMeanInterval(values, {.seed = 6}).low);
}

TEST(MedianInterval, RunsBetweenTheOrderStatisticsOfTheSignTest) {
  // Of 10 fair coins P(heads ≤ 1) = 11/1024 = 1.1 % and P(heads ≤ 2) = 5.5 %: the second smallest
  // and the second largest value at 95 %, the third ones at 85 %.
  const std::vector<double> values = {9.0, 1.0, 8.0, 2.0, 7.0, 3.0, 6.0, 4.0, 5.0, 100.0};
  EXPECT_EQ(MedianInterval(values, 0.95).low, 2.0);
  EXPECT_EQ(MedianInterval(values, 0.95).high, 9.0);
  EXPECT_EQ(MedianInterval(values, 0.85).low, 3.0);
  EXPECT_EQ(MedianInterval(values, 0.85).high, 8.0);
  const std::vector<double> five(5, 1.0), six(6, 1.0);
  EXPECT_EQ(MedianInterval(five, 0.95).high, kInfinity);
  EXPECT_EQ(MedianInterval(six, 0.95).high, 1.0);
  EXPECT_EQ(FewestPairs(0.95), 6);
  EXPECT_EQ(MedianInterval({}, 0.95).low, -kInfinity);
}

// How often the interval of `count` values drawn by `draw`, whose mean is 0, holds 0.
template <class Draw>
double Coverage(int count, Draw draw) {
  constexpr int kTrials = 800;
  RandomStream random(17, "coverage");
  int held = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i) values.push_back(draw(random));
    const Interval interval = BootstrapMeanInterval(
        values, {.resamples = 1000, .seed = static_cast<std::uint64_t>(trial)});
    held += interval.low <= 0.0 && interval.high >= 0.0 ? 1 : 0;
  }
  return static_cast<double>(held) / kTrials;
}

// The standard error of these shares is 0.8 %. Of six values the interval is a little too narrow.
TEST(BootstrapMeanInterval, HoldsTheMeanAsOftenAsItSays) {
  const auto normal = [](RandomStream& random) { return random.Normal(); };
  const auto uniform = [](RandomStream& random) { return random.Uniform(-1.0, 1.0); };
  EXPECT_NEAR(Coverage(6, normal), 0.93, 0.025);
  EXPECT_NEAR(Coverage(9, normal), 0.95, 0.025);
  EXPECT_NEAR(Coverage(30, normal), 0.95, 0.025);
  EXPECT_NEAR(Coverage(9, uniform), 0.95, 0.025);
}

TEST(ComparePairs, CallsADifferenceOnlyWhereTheIntervalExcludesZero) {
  const std::vector<double> reference = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  const std::vector<double> higher = {1.2, 2.3, 3.1, 4.2, 5.3, 6.1};
  const std::vector<double> mixed = {1.2, 1.7, 3.1, 3.8, 5.3, 5.9};
  const PairedComparison up = ComparePairs(reference, higher);
  EXPECT_EQ(up.verdict, Difference::kHigher);
  EXPECT_NEAR(up.difference.mean, 0.2, 1e-12);
  EXPECT_GT(up.interval.low, 0.0);
  EXPECT_EQ(ComparePairs(higher, reference).verdict, Difference::kLower);
  EXPECT_EQ(ComparePairs(reference, mixed).verdict, Difference::kNone);
  EXPECT_EQ(ComparePairs(reference, reference).verdict, Difference::kNone);
}

TEST(ComparePairs, IsNotFooledByASpreadThatBothShare) {
  // Scenes differ by far more than the variants, as scenes do: only pairs show the difference.
  std::vector<double> reference, other;
  for (int scene = 0; scene < 6; ++scene) {
    reference.push_back(std::exp(scene));
    other.push_back(std::exp(scene) + 0.01 * (1 + scene % 2));
  }
  EXPECT_EQ(ComparePairs(reference, other).verdict, Difference::kHigher);
}

TEST(ComparePairs, SaysWhenPairsAreTooFew) {
  EXPECT_EQ(FewestPairs(0.95), 6);
  EXPECT_EQ(FewestPairs(0.5), 2);
  const std::vector<double> reference(5, 1.0), other(5, 2.0);
  EXPECT_EQ(ComparePairs(reference, other).verdict, Difference::kTooFewPairs);
  EXPECT_THROW(ComparePairs(reference, {}), std::invalid_argument);
}

TEST(ParetoFront, HoldsWhatNothingElseBeats) {
  const std::vector<Costs> costs = {{1, 5}, {2, 3}, {3, 3}, {4, 1}, {2, 3}, {5, 5}, {NAN, 0}};
  EXPECT_EQ(ParetoFront(costs), (std::vector<bool>{true, true, false, true, true, false, false}));
  EXPECT_TRUE(ParetoFront({}).empty());
}

}  // namespace
}  // namespace vitruvia
