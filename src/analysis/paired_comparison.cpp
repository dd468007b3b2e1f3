#include "analysis/paired_comparison.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "core/random.h"
#include "math/statistics.h"

namespace vitruvia {
namespace {

// The share of resampled means to cut off at each end.
double ExpandedTail(double confidence, std::size_t count) {
  const double n = static_cast<double>(count);
  const double t = StudentQuantile(confidence, static_cast<int>(count) - 1);
  return 0.5 * std::erfc(std::sqrt(n / (n - 1.0)) * t / std::numbers::sqrt2);
}

// Means of samples that `draw` makes, in order of size.
template <class Draw>
std::vector<double> ResampledMeans(const BootstrapSettings& settings, Draw draw) {
  Require(settings.resamples >= 1, "bootstrap of {} resamples", settings.resamples);
  RandomStream random(settings.seed, "bootstrap");
  std::vector<double> means;
  means.reserve(settings.resamples);
  for (int r = 0; r < settings.resamples; ++r) means.push_back(draw(random));
  std::sort(means.begin(), means.end());
  return means;
}

double SumOfDrawn(std::span<const double> values, RandomStream& random) {
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += values[random.Index(values.size())];
  return sum;
}

double MeanOfDrawnGroups(const Groups& groups, RandomStream& random) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const std::vector<double>& group = groups[random.Index(groups.size())];
    sum += SumOfDrawn(group, random);
    count += group.size();
  }
  return sum / static_cast<double>(count);
}

// Percentile interval, expanded to the width of Student's interval for that many units.
Interval ExpandedInterval(const std::vector<double>& means, std::size_t units, double confidence) {
  const double tail = ExpandedTail(confidence, units);
  return {Quantile(means, tail), Quantile(means, 1.0 - tail)};
}

std::vector<double> Joined(const Groups& groups) {
  std::vector<double> all;
  for (const std::vector<double>& group : groups) all.insert(all.end(), group.begin(), group.end());
  return all;
}

std::vector<double> Units(const Groups& groups) {
  if (groups.size() == 1) return groups.front();
  std::vector<double> means;
  for (const std::vector<double>& group : groups) means.push_back(Mean(group));
  return means;
}

// p-value of Student's two-sided test of the mean against 0.
double PValue(const SampleSpread& spread) {
  if (spread.count < 2 || spread.mean == 0.0) return 1.0;
  if (spread.deviation == 0.0) return 0.0;
  const double t = std::abs(spread.mean) / (spread.deviation / std::sqrt(spread.count));
  const boost::math::students_t distribution(spread.count - 1);
  return 2.0 * boost::math::cdf(boost::math::complement(distribution, t));
}

bool HasEnoughPairs(const PairedComparison& comparison, double confidence) {
  return comparison.difference.count >= FewestPairs(confidence);
}

Difference VerdictOf(const PairedComparison& comparison, double confidence) {
  if (!HasEnoughPairs(comparison, confidence)) return Difference::kTooFewPairs;
  if (comparison.adjusted_p > 1.0 - confidence) return Difference::kNotShown;
  if (comparison.interval.high < 0.0) return Difference::kLower;
  if (comparison.interval.low > 0.0) return Difference::kHigher;
  return Difference::kNotShown;
}

}  // namespace

SampleSpread SpreadOf(std::span<const double> values) {
  SampleSpread spread;
  spread.count = static_cast<int>(values.size());
  if (values.empty()) return spread;
  spread.mean = Mean(values);
  if (values.size() < 2) return spread;
  double squares = 0.0;
  for (const double value : values) squares += (value - spread.mean) * (value - spread.mean);
  spread.deviation = std::sqrt(squares / static_cast<double>(values.size() - 1));
  return spread;
}

double StudentQuantile(double confidence, int degrees_of_freedom) {
  Require(confidence > 0.0 && confidence < 1.0, "StudentQuantile: confidence {}", confidence);
  Require(degrees_of_freedom >= 1, "StudentQuantile: {} degrees of freedom", degrees_of_freedom);
  const boost::math::students_t distribution(degrees_of_freedom);
  return boost::math::quantile(distribution, 0.5 * (1.0 + confidence));
}

Interval BootstrapMeanInterval(std::span<const double> values, const BootstrapSettings& settings) {
  Require(!values.empty(), "BootstrapMeanInterval of an empty sample");
  if (values.size() == 1) {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
  // If all differences are equal, rounding of their mean must not create a spread.
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  if (*least == *most) return {*least, *most};
  const std::vector<double> means = ResampledMeans(settings, [&](RandomStream& random) {
    return SumOfDrawn(values, random) / static_cast<double>(values.size());
  });
  return ExpandedInterval(means, values.size(), settings.confidence);
}

Interval GroupedMeanInterval(const Groups& groups, const BootstrapSettings& settings) {
  Require(!groups.empty(), "GroupedMeanInterval of no group");
  for (const std::vector<double>& group : groups)
    Require(!group.empty(), "GroupedMeanInterval: a group of {} has no value", groups.size());
  if (groups.size() == 1) return BootstrapMeanInterval(groups.front(), settings);
  const std::vector<double> all = Joined(groups);
  const auto [least, most] = std::minmax_element(all.begin(), all.end());
  if (*least == *most) return {*least, *most};
  const std::vector<double> means = ResampledMeans(
      settings, [&](RandomStream& random) { return MeanOfDrawnGroups(groups, random); });
  return ExpandedInterval(means, groups.size(), settings.confidence);
}

Interval MedianInterval(std::span<const double> values, double confidence) {
  Require(confidence > 0.0 && confidence < 1.0, "MedianInterval: confidence {}", confidence);
  const double tail = 0.5 * (1.0 - confidence);
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  // The median lies below the k-th smallest value where fewer than k of n fair coins show heads.
  const boost::math::binomial_distribution coins(static_cast<double>(sorted.size()), 0.5);
  std::size_t k = 0;
  while (2 * (k + 1) <= sorted.size() && boost::math::cdf(coins, static_cast<double>(k)) <= tail) {
    ++k;
  }
  if (k == 0) {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
  return {sorted[k - 1], sorted[sorted.size() - k]};
}

int FewestPairs(double confidence) {
  Require(confidence > 0.0 && confidence < 1.0, "FewestPairs: confidence {}", confidence);
  int pairs = 1;
  while (std::exp2(1 - pairs) > 1.0 - confidence) ++pairs;
  return pairs;
}

const char* Name(Difference difference) {
  switch (difference) {
    case Difference::kTooFewPairs:
      return "too few pairs";
    case Difference::kNotShown:
      return "difference not shown";
    case Difference::kLower:
      return "lower";
    case Difference::kHigher:
      return "higher";
  }
  return "";
}

PairedComparison ComparePairs(const Groups& differences, const BootstrapSettings& settings) {
  const std::vector<double> all = Joined(differences);
  Require(!all.empty(), "ComparePairs of no pair");
  PairedComparison comparison;
  comparison.difference = SpreadOf(all);
  comparison.unit_difference = SpreadOf(Units(differences));
  comparison.scenes = static_cast<int>(differences.size());
  comparison.interval = GroupedMeanInterval(differences, settings);
  comparison.p = comparison.adjusted_p = PValue(comparison.unit_difference);
  comparison.verdict = VerdictOf(comparison, settings.confidence);
  return comparison;
}

void AdjustByHolm(std::span<PairedComparison* const> comparisons, double confidence) {
  std::vector<PairedComparison*> tested;
  for (PairedComparison* comparison : comparisons) {
    if (HasEnoughPairs(*comparison, confidence)) tested.push_back(comparison);
  }
  std::stable_sort(tested.begin(), tested.end(),
                   [](const auto* a, const auto* b) { return a->p < b->p; });
  double largest = 0.0;
  for (std::size_t i = 0; i < tested.size(); ++i) {
    largest = std::max(largest, tested[i]->p * static_cast<double>(tested.size() - i));
    tested[i]->adjusted_p = std::min(largest, 1.0);
    tested[i]->verdict = VerdictOf(*tested[i], confidence);
  }
}

int UnitsToShow(double difference, double deviation, double confidence, double power) {
  Require(difference > 0.0 && deviation > 0.0, "UnitsToShow: difference {}, deviation {}",
          difference, deviation);
  Require(power > 0.5 && power < 1.0, "UnitsToShow: power {}", power);
  constexpr int kMost = 1'000'000;
  const double effect = difference / deviation;
  for (int n = 2; n < kMost; ++n) {
    const boost::math::non_central_t other(n - 1, effect * std::sqrt(n));
    if (boost::math::cdf(boost::math::complement(other, StudentQuantile(confidence, n - 1))) >=
        power)
      return n;
    if (n > 200) n += n / 20;  // of many the last per cent does not matter
  }
  return kMost;
}

}  // namespace vitruvia
