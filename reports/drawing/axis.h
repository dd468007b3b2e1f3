// Axes of plots: positions of values, and ticks.
#pragma once

#include <string>
#include <vector>

namespace vitruvia {

enum class Scale { kLinear, kLogarithmic };

struct Tick {
  double value = 0.0;
  std::string label;
};

class Axis {
 public:
  // From `start` to `end`, which must be greater.
  static Axis Linear(double start, double end);
  // From the last of 1, 2, 5 × 10ⁿ not above `low` to the first not below `high`; both positive.
  static Axis Logarithmic(double low, double high);

  double Share(double value) const;  // position of a value: 0 at the start, 1 at the end, clamped
  bool Holds(double value) const;
  // At round values: about `count` on a linear axis, each of 1, 2, 5 × 10ⁿ on a logarithmic one, or
  // of 10ⁿ where these are more than `count`.
  std::vector<Tick> Ticks(int count) const;

 private:
  std::vector<Tick> LinearTicks(int count) const;
  std::vector<Tick> LogarithmicTicks(int count) const;

  Axis(Scale scale, double start, double end) : scale_(scale), start_(start), end_(end) {}

  Scale scale_;
  double start_, end_;
};

// The smallest of 1, 2, 5 × 10ⁿ not below `value`, which must be positive.
double RoundedUp(double value);

}  // namespace vitruvia
