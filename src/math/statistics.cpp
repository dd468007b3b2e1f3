#include "math/statistics.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace vitruvia {

double Quantile(std::vector<double> values, double share) {
  Require(!values.empty(), "Quantile of an empty sample");
  Require(share >= 0.0 && share <= 1.0, "Quantile: share {} is not in [0, 1]", share);
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(std::floor(place));
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - std::floor(place)) * (values[above] - values[below]);
}

double Mean(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

double Maximum(std::span<const double> values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

std::vector<double> PresentValues(std::span<const double> values) {
  std::vector<double> present;
  std::copy_if(values.begin(), values.end(), std::back_inserter(present),
               [](double value) { return !std::isnan(value); });
  return present;
}

}  // namespace vitruvia
