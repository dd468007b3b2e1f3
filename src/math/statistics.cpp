#include "math/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/absent.h"
#include "core/error.h"

namespace vitruvia {
namespace {

// From 1; equal values share the mean of their ranks.
std::vector<double> Ranks(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return values[i] < values[j]; });
  std::vector<double> ranks(values.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    for (std::size_t k = begin; k < end; ++k)
      ranks[order[k]] = 0.5 * static_cast<double>(begin + 1 + end);
    begin = end;
  }
  return ranks;
}

}  // namespace

double Quantile(std::vector<double> values, double share) {
  Require(!values.empty(), "Quantile of an empty sample");
  Require(share >= 0.0 && share <= 1.0, "Quantile: share {} is not in [0, 1]", share);
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = values.begin() + static_cast<std::ptrdiff_t>(std::floor(place));
  std::nth_element(values.begin(), below, values.end());
  const double above =
      below + 1 == values.end() ? *below : *std::min_element(below + 1, values.end());
  return *below + (place - std::floor(place)) * (above - *below);
}

double MeanOrAbsent(std::span<const double> values) {
  return values.empty() ? kAbsent : Mean(values);
}

double MaximumOrAbsent(std::span<const double> values) {
  return values.empty() ? kAbsent : Maximum(values);
}

double Mean(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

double Maximum(std::span<const double> values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

double RankCorrelation(std::span<const double> a, std::span<const double> b) {
  constexpr std::size_t kFewestPairs = 3;
  Require(a.size() == b.size(), "RankCorrelation of {} and {} values", a.size(), b.size());
  const std::vector<double> x = Ranks(a), y = Ranks(b);
  const double mean = 0.5 * (static_cast<double>(a.size()) + 1.0);
  double xy = 0.0, xx = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mean) * (y[i] - mean);
    xx += (x[i] - mean) * (x[i] - mean);
    yy += (y[i] - mean) * (y[i] - mean);
  }
  if (a.size() < kFewestPairs || xx == 0.0 || yy == 0.0)
    return std::numeric_limits<double>::quiet_NaN();
  return xy / std::sqrt(xx * yy);
}

std::vector<double> PresentValues(std::span<const double> values) {
  std::vector<double> present;
  std::copy_if(values.begin(), values.end(), std::back_inserter(present),
               [](double value) { return !std::isnan(value); });
  return present;
}

}  // namespace vitruvia
