// What repeats and seeds say: spread, and whether two paired samples differ.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

namespace vitruvia {

struct SampleSpread {
  int count = 0;
  double mean = std::numeric_limits<double>::quiet_NaN();  // NaN of an empty sample
  double deviation =
      std::numeric_limits<double>::quiet_NaN();  // n − 1 below; NaN of fewer than two
};
SampleSpread SpreadOf(std::span<const double> values);

// t with P(|T| ≤ t) = confidence for Student's distribution.
double StudentQuantile(double confidence, int degrees_of_freedom);

struct BootstrapSettings {
  double confidence = 0.95;
  int resamples = 10000;
  std::uint64_t seed = 1;
};

struct Interval {
  double low = 0.0, high = 0.0;
};

// Of the mean of what the values were drawn from: the percentile bootstrap, its percentiles moved
// outwards so that it is as wide as Student's interval where values are normal (Hesterberg 2015,
// "What Teachers Should Know About the Bootstrap", the expanded percentile interval). Without that
// it is too narrow for the six or ten values that an experiment has; of six normal ones it still
// holds the mean in 93 % of all cases, where it says 95, of nine in 94 to 95. One value: [−∞, ∞].
// std::invalid_argument on an empty sample or settings out of range.
Interval BootstrapMeanInterval(std::span<const double> values, const BootstrapSettings& settings);

// Of the median of what the values were drawn from, whatever their distribution: the sign test's
// interval, from an order statistic to its mirror image, the narrowest that holds the median with
// at least this probability. One value far off does not move it. [−∞, ∞] of fewer values than
// FewestPairs(confidence).
Interval MedianInterval(std::span<const double> values, double confidence);

// With fewer pairs than this even differences that all have one sign arise by chance more often
// than in 1 − confidence of all cases (a sign test's 2^(1 − n)), so none is called one: 6 at 95 %.
int FewestPairs(double confidence);

enum class Difference { kTooFewPairs, kNone, kLower, kHigher };
const char* Name(Difference difference);

struct PairedComparison {
  SampleSpread difference;                        // other − reference, over the pairs
  Interval interval;                              // of its mean
  Difference verdict = Difference::kTooFewPairs;  // of the other against the reference
};

// reference[i] and other[i] are one pair: the same scene and seed. A difference is called one only
// if its interval excludes zero. std::invalid_argument unless both have one, positive, length.
PairedComparison ComparePairs(std::span<const double> reference, std::span<const double> other,
                              const BootstrapSettings& settings = {});

}  // namespace vitruvia
