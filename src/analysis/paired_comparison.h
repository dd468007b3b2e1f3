// Statistics over repeats and seeds: spread, and tests whether two paired samples differ.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace vitruvia {

struct SampleSpread {
  int count = 0;
  double mean = std::numeric_limits<double>::quiet_NaN();       // NaN for an empty sample
  double deviation = std::numeric_limits<double>::quiet_NaN();  // with divisor n − 1; NaN for fewer
                                                                // than two values
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

// Confidence interval of the mean of the values' distribution, by the expanded percentile bootstrap
// (Hesterberg 2015, "What Teachers Should Know About the Bootstrap"): the percentiles are moved
// outwards so that the interval is as wide as Student's for normal values. The plain percentile
// interval is too narrow for the six to ten values of an experiment. At 95 % nominal, this one
// covers the mean of normal values in 93 % of all cases with six values, and in 94 to 95 % with
// nine. One value: [−∞, ∞]. std::invalid_argument for an empty sample or settings out of range.
Interval BootstrapMeanInterval(std::span<const double> values, const BootstrapSettings& settings);

// Values in groups that are independent of each other: one for each scene, of its seeds.
using Groups = std::vector<std::vector<double>>;

// Confidence interval of the mean of the groups' distribution: groups are resampled, then values
// within each. It is expanded to the width of Student's interval for that many groups (see above).
// For a single group, the interval of its values. std::invalid_argument if there is no group or a
// group is empty.
Interval GroupedMeanInterval(const Groups& groups, const BootstrapSettings& settings);

// Distribution-free confidence interval of the median, from the sign test: the narrowest interval
// between the k-th smallest and the k-th largest value that contains the median with at least this
// probability. Robust to single outliers. [−∞, ∞] for fewer values than FewestPairs(confidence).
Interval MedianInterval(std::span<const double> values, double confidence);

// The least number of pairs for which differences can be significant: with fewer, even differences
// of the same sign arise by chance with a probability above 1 − confidence (sign test: 2^(1 − n)).
// 6 at 95 %.
int FewestPairs(double confidence);

enum class Difference { kTooFewPairs, kNotShown, kLower, kHigher };
const char* Name(Difference difference);

struct PairedComparison {
  SampleSpread difference;  // other − reference, over the pairs
  // Over the independent units: the means of scenes or, for a single scene, its pairs.
  SampleSpread unit_difference;
  int scenes = 0;
  Interval interval;  // of the mean difference
  // p-value of the mean difference over units (Student's t); 1 for one unit.
  double p = 1.0;
  double adjusted_p = 1.0;                        // see AdjustByHolm
  Difference verdict = Difference::kTooFewPairs;  // of the other compared with the reference
};

// `differences` of pairs, other − reference, grouped by scene: six pairs from two scenes are not
// six independent ones. A difference is significant only if its interval excludes zero, adjusted_p
// is at most 1 − confidence and there are at least FewestPairs pairs. std::invalid_argument if
// there is no pair.
PairedComparison ComparePairs(const Groups& differences, const BootstrapSettings& settings = {});

// Holm's correction (1979) for multiple comparisons: the probability of at least one false positive
// is at most 1 − confidence. Sets adjusted_p and the verdicts; comparisons with too few pairs do
// not count.
void AdjustByHolm(std::span<PairedComparison* const> comparisons, double confidence);

// Number of independent units needed to show a difference of that size with probability `power`, if
// the units have the standard deviation `deviation` (normal; Student's t-test). At least 2;
// std::invalid_argument unless difference and deviation are positive.
int UnitsToShow(double difference, double deviation, double confidence, double power);

}  // namespace vitruvia
