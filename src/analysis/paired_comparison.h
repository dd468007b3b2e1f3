// What repeats and seeds say: spread, and whether two paired samples differ.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

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

// Values in groups that are independent of each other: one for each scene, of its seeds.
using Groups = std::vector<std::vector<double>>;

// Of the mean of what the groups were drawn from: groups are drawn anew, then values within each.
// As wide as Student's interval of that many groups (see above). Of a single group, that of its
// values. std::invalid_argument if a group is empty or there is none.
Interval GroupedMeanInterval(const Groups& groups, const BootstrapSettings& settings);

// Of the median of what the values were drawn from, whatever their distribution: the sign test's
// interval, from an order statistic to its mirror image, the narrowest that holds the median with
// at least this probability. One value far off does not move it. [−∞, ∞] of fewer values than
// FewestPairs(confidence).
Interval MedianInterval(std::span<const double> values, double confidence);

// With fewer pairs than this even differences that all have one sign arise by chance more often
// than in 1 − confidence of all cases (a sign test's 2^(1 − n)), so none is called one: 6 at 95 %.
int FewestPairs(double confidence);

enum class Difference { kTooFewPairs, kNotShown, kLower, kHigher };
const char* Name(Difference difference);

struct PairedComparison {
  SampleSpread difference;  // other − reference, over the pairs
  // Of the independent units: means of scenes, or, of a single scene, its pairs.
  SampleSpread unit_difference;
  int scenes = 0;
  Interval interval;  // of the mean difference
  // That units whose mean difference is 0 differ by so much (Student's t); of one unit 1.
  double p = 1.0;
  double adjusted_p = 1.0;                        // see AdjustByHolm
  Difference verdict = Difference::kTooFewPairs;  // of the other against the reference
};

// `differences` of pairs, other − reference, grouped by scene: six pairs from two scenes are not
// six independent ones. A difference is called one only if its interval excludes zero, adjusted_p
// is at most 1 − confidence and there are FewestPairs. std::invalid_argument if there is none.
PairedComparison ComparePairs(const Groups& differences, const BootstrapSettings& settings = {});

// Holm's correction (1979) for comparisons that are made together: with it, the probability that
// any difference is called one by chance is at most 1 − confidence. Sets adjusted_p and the
// verdicts; comparisons of too few pairs do not count.
void AdjustByHolm(std::span<PairedComparison* const> comparisons, double confidence);

// How many independent units it takes to show a difference of that size with this probability, if
// units differ by `deviation` (normal; Student's test). At least 2; std::invalid_argument unless
// difference and deviation are positive.
int UnitsToShow(double difference, double deviation, double confidence, double power);

}  // namespace vitruvia
