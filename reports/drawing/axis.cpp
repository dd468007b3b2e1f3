#include "reports/drawing/axis.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vitruvia {
namespace {

constexpr double kRounding = 1e-9;  // of values that are round but for their last bits

// Both differ from RoundedUp(value) only where value is not round.
double RoundedDown(double value) {
  const double up = RoundedUp(value);
  if (up <= value * (1.0 + kRounding)) return up;
  // The neighbour below: …, 1, 2, 5, 10, …
  const double mantissa = up / std::pow(10.0, std::floor(std::log10(up) + kRounding));
  return mantissa > 4.0 ? up * 0.4 : up * 0.5;
}

}  // namespace

double RoundedUp(double value) {
  const double magnitude = std::pow(10.0, std::floor(std::log10(value) + kRounding));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * magnitude >= value * (1.0 - kRounding)) return factor * magnitude;
  }
  return 10.0 * magnitude;
}

Axis Axis::Linear(double start, double end) { return {Scale::kLinear, start, end}; }

Axis Axis::Logarithmic(double low, double high) {
  const double start = RoundedDown(low);
  return {Scale::kLogarithmic, start, std::max(RoundedUp(high), 2.0 * start)};
}

double Axis::Share(double value) const {
  const double share = scale_ == Scale::kLinear
                           ? (value - start_) / (end_ - start_)
                           : std::log(std::max(value, start_) / start_) / std::log(end_ / start_);
  return std::clamp(share, 0.0, 1.0);
}

bool Axis::Holds(double value) const {
  const double rounding = kRounding * std::max(std::abs(start_), std::abs(end_));
  return value >= start_ - rounding && value <= end_ + rounding;
}

std::vector<Tick> Axis::Ticks(int count) const {
  return scale_ == Scale::kLinear ? LinearTicks(count) : LogarithmicTicks(count);
}

std::vector<Tick> Axis::LinearTicks(int count) const {
  const double step = RoundedUp((end_ - start_) / std::max(count, 1));
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + kRounding)));
  std::vector<Tick> ticks;
  for (double i = std::ceil(start_ / step - kRounding); Holds(i * step); ++i)
    ticks.push_back({i * step, fmt::format("{:.{}f}", i * step + 0.0, decimals)});  // no −0
  return ticks;
}

std::vector<Tick> Axis::LogarithmicTicks(int count) const {
  std::vector<Tick> all, decades;
  for (double value = start_; Holds(value); value = RoundedUp(value * 1.5)) {
    all.push_back({value, fmt::format("{:g}", value)});
    const double exponent = std::log10(value);
    if (std::abs(exponent - std::round(exponent)) < kRounding) decades.push_back(all.back());
  }
  return static_cast<int>(all.size()) > count && decades.size() > 2 ? decades : all;
}

}  // namespace vitruvia
