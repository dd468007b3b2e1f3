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

TEST(GroupedMeanInterval, OfOneGroupIsThatOfItsValues) {
  const std::vector<double> values = {0.3, 1.2, -0.4, 0.8, 2.1, 0.9};
  EXPECT_EQ(GroupedMeanInterval({values}, {}).low, BootstrapMeanInterval(values, {}).low);
  EXPECT_THROW(GroupedMeanInterval({{1.0}, {}}, {}), std::invalid_argument);
}

// Seeds of a scene share what the scene does: with a scene's effect as large as the noise, an
// interval that takes 24 pairs of 6 scenes for independent holds the mean far too rarely.
TEST(GroupedMeanInterval, HoldsTheMeanWherePairsOfAScenesShareItsEffect) {
  constexpr int kTrials = 300, kScenes = 6, kSeeds = 4;
  RandomStream random(23, "grouped");
  int held = 0, held_if_pooled = 0;
  const auto holds = [](const Interval& i) { return i.low <= 0.0 && i.high >= 0.0 ? 1 : 0; };
  for (int trial = 0; trial < kTrials; ++trial) {
    Groups groups;
    std::vector<double> pooled;
    for (int scene = 0; scene < kScenes; ++scene) {
      const double effect = random.Normal();
      std::vector<double>& group = groups.emplace_back();
      for (int seed = 0; seed < kSeeds; ++seed) group.push_back(effect + 0.5 * random.Normal());
      pooled.insert(pooled.end(), group.begin(), group.end());
    }
    const BootstrapSettings settings{.resamples = 500};
    held += holds(GroupedMeanInterval(groups, settings));
    held_if_pooled += holds(BootstrapMeanInterval(pooled, settings));
  }
  EXPECT_GE(held, 0.91 * kTrials);
  EXPECT_LE(held_if_pooled, 0.80 * kTrials);
}

Groups Differences(const std::vector<double>& reference, const std::vector<double>& other) {
  Groups groups(1);
  for (std::size_t i = 0; i < other.size(); ++i) groups[0].push_back(other[i] - reference[i]);
  return groups;
}

TEST(ComparePairs, CallsADifferenceOnlyWhereTheIntervalExcludesZero) {
  const std::vector<double> reference = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  const std::vector<double> higher = {1.2, 2.3, 3.1, 4.2, 5.3, 6.1};
  const std::vector<double> mixed = {1.2, 1.7, 3.1, 3.8, 5.3, 5.9};
  const PairedComparison up = ComparePairs(Differences(reference, higher));
  EXPECT_EQ(up.verdict, Difference::kHigher);
  EXPECT_NEAR(up.difference.mean, 0.2, 1e-12);
  EXPECT_GT(up.interval.low, 0.0);
  // Differences 0.2, 0.3, 0.1 twice: t = 0.2 / (0.0894 / √6) = 5.48 with 5 degrees of freedom.
  EXPECT_NEAR(up.p, 0.0028, 1e-4);
  EXPECT_EQ(ComparePairs(Differences(higher, reference)).verdict, Difference::kLower);
  EXPECT_EQ(ComparePairs(Differences(reference, mixed)).verdict, Difference::kNotShown);
  EXPECT_EQ(ComparePairs(Differences(reference, reference)).verdict, Difference::kNotShown);
}

TEST(ComparePairs, SixPairsOfTwoScenesAreTwo) {
  const PairedComparison of_one = ComparePairs({{1.0, 1.1, 0.9, 2.0, 2.1, 1.9}});
  const PairedComparison of_two = ComparePairs({{1.0, 1.1, 0.9}, {2.0, 2.1, 1.9}});
  EXPECT_EQ(of_one.verdict, Difference::kHigher);
  EXPECT_EQ(of_two.difference.count, 6);
  EXPECT_EQ(of_two.unit_difference.count, 2);
  EXPECT_EQ(of_two.verdict, Difference::kNotShown);
  EXPECT_GT(of_two.p, 0.1);  // t = 3 with one degree of freedom: 0.20
}

TEST(ComparePairs, IsNotFooledByASpreadThatBothShare) {
  // Scenes differ by far more than the variants, as scenes do: only pairs show the difference.
  Groups groups;
  for (int scene = 0; scene < 6; ++scene)
    groups.push_back({std::exp(scene) + 0.01 * (1 + scene % 2) - std::exp(scene)});
  EXPECT_EQ(ComparePairs(groups).verdict, Difference::kHigher);
}

TEST(ComparePairs, SaysWhenPairsAreTooFew) {
  EXPECT_EQ(FewestPairs(0.95), 6);
  EXPECT_EQ(FewestPairs(0.5), 2);
  EXPECT_EQ(ComparePairs({std::vector<double>(5, 1.0)}).verdict, Difference::kTooFewPairs);
  EXPECT_THROW(ComparePairs({}), std::invalid_argument);
}

PairedComparison WithP(double p) {
  PairedComparison comparison = ComparePairs({{1.0, 1.1, 0.9, 1.0, 1.1, 0.9}});
  comparison.p = p;
  return comparison;
}

TEST(AdjustByHolm, MultipliesTheSmallestByTheirNumberAndKeepsTheOrder) {
  // Holm 1979: 0.01 × 4, 0.02 × 3, 0.022 × 2 raised to what stands before it, 0.8 × 1.
  std::vector<PairedComparison> all = {WithP(0.02), WithP(0.01), WithP(0.8), WithP(0.022)};
  PairedComparison few = ComparePairs({{1.0}});
  few.p = 1e-9;
  AdjustByHolm(std::vector<PairedComparison*>{&all[0], &all[1], &all[2], &all[3], &few}, 0.95);
  EXPECT_NEAR(all[1].adjusted_p, 0.04, 1e-12);
  EXPECT_NEAR(all[0].adjusted_p, 0.06, 1e-12);
  EXPECT_NEAR(all[3].adjusted_p, 0.06, 1e-12);
  EXPECT_NEAR(all[2].adjusted_p, 0.8, 1e-12);
  EXPECT_EQ(all[1].verdict, Difference::kHigher);
  EXPECT_EQ(all[0].verdict, Difference::kNotShown);
  EXPECT_EQ(few.verdict, Difference::kTooFewPairs);
}

TEST(UnitsToShow, AgreesWithPublishedTables) {
  // Two-sided paired test at 5 % with a power of 80 %: Cohen 1988, table 2.4.1, and G*Power.
  EXPECT_EQ(UnitsToShow(0.5, 1.0, 0.95, 0.8), 34);
  EXPECT_EQ(UnitsToShow(0.8, 1.0, 0.95, 0.8), 15);
  EXPECT_EQ(UnitsToShow(2.0, 2.0, 0.95, 0.8), 10);
  EXPECT_THROW(UnitsToShow(0.0, 1.0, 0.95, 0.8), std::invalid_argument);
}

TEST(ParetoFront, HoldsWhatNothingElseBeats) {
  const std::vector<Costs> costs = {{1, 5}, {2, 3}, {3, 3}, {4, 1}, {2, 3}, {5, 5}, {NAN, 0}};
  EXPECT_EQ(ParetoFront(costs), (std::vector<bool>{true, true, false, true, true, false, false}));
  EXPECT_TRUE(ParetoFront({}).empty());
}

}  // namespace
}  // namespace vitruvia
