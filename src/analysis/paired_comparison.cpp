#include "analysis/paired_comparison.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "core/random.h"
#include "math/statistics.h"

namespace vitruvia {
namespace {

// The share of resampled means to cut off at either end.
double ExpandedTail(double confidence, std::size_t count) {
  const double n = static_cast<double>(count);
  const double t = StudentQuantile(confidence, static_cast<int>(count) - 1);
  return 0.5 * std::erfc(std::sqrt(n / (n - 1.0)) * t / std::numbers::sqrt2);
}

std::vector<double> ResampledMeans(std::span<const double> values,
                                   const BootstrapSettings& settings) {
  RandomStream random(settings.seed, "bootstrap");
  std::vector<double> means;
  means.reserve(settings.resamples);
  for (int r = 0; r < settings.resamples; ++r) {
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) sum += values[random.Index(values.size())];
    means.push_back(sum / static_cast<double>(values.size()));
  }
  std::sort(means.begin(), means.end());
  return means;
}

Difference VerdictOf(const PairedComparison& comparison, double confidence) {
  if (comparison.difference.count < FewestPairs(confidence)) return Difference::kTooFewPairs;
  if (comparison.interval.high < 0.0) return Difference::kLower;
  if (comparison.interval.low > 0.0) return Difference::kHigher;
  return Difference::kNone;
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
  Require(settings.resamples >= 1, "BootstrapMeanInterval: {} resamples", settings.resamples);
  if (values.size() == 1) {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
  // Rounding of a mean must not make a difference of differences that are all the same.
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  if (*least == *most) return {*least, *most};
  const std::vector<double> means = ResampledMeans(values, settings);
  const double tail = ExpandedTail(settings.confidence, values.size());
  return {Quantile(means, tail), Quantile(means, 1.0 - tail)};
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
    case Difference::kNone:
      return "no difference";
    case Difference::kLower:
      return "lower";
    case Difference::kHigher:
      return "higher";
  }
  return "";
}

PairedComparison ComparePairs(std::span<const double> reference, std::span<const double> other,
                              const BootstrapSettings& settings) {
  Require(reference.size() == other.size() && !other.empty(),
          "ComparePairs: {} reference values and {} others", reference.size(), other.size());
  std::vector<double> differences;
  for (std::size_t i = 0; i < other.size(); ++i) differences.push_back(other[i] - reference[i]);
  PairedComparison comparison;
  comparison.difference = SpreadOf(differences);
  comparison.interval = BootstrapMeanInterval(differences, settings);
  comparison.verdict = VerdictOf(comparison, settings.confidence);
  return comparison;
}

}  // namespace vitruvia
