// Order statistics of a sample.
#pragma once

#include <span>
#include <vector>

namespace vitruvia {

// Linear interpolation between order statistics (type 7 of Hyndman & Fan 1996); share in [0, 1].
// Throws std::invalid_argument on an empty sample.
double Quantile(std::vector<double> values, double share);
double Mean(std::span<const double> values);     // 0 of an empty sample
double Maximum(std::span<const double> values);  // 0 of an empty sample
// The same, but kAbsent (core/absent.h) for an empty sample.
double MeanOrAbsent(std::span<const double> values);
double MaximumOrAbsent(std::span<const double> values);
// Spearman's rank correlation; ties share their mean rank. NaN for fewer than three pairs or a
// constant sample. Both samples must have the same length.
double RankCorrelation(std::span<const double> a, std::span<const double> b);
// The values that are not NaN: a series of frames holds NaN where there is no value.
std::vector<double> PresentValues(std::span<const double> values);

}  // namespace vitruvia
