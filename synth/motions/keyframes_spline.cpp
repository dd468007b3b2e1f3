#include "synth/motions/keyframes_spline.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace vitruvia {
namespace {

struct Interval {
  double width, slope;
};

// Steffen 1990, eq. 11: the parabola's slope, cut so that either interval stays monotone.
double SlopeBetween(const Interval& left, const Interval& right) {
  if (left.slope * right.slope <= 0.0) return 0.0;
  const double parabola =
      (left.slope * right.width + right.slope * left.width) / (left.width + right.width);
  const double limit = 2.0 * std::min(std::abs(left.slope), std::abs(right.slope));
  return std::copysign(std::min(std::abs(parabola), limit), parabola);
}

}  // namespace

MonotoneSpline::MonotoneSpline(std::vector<double> times, std::vector<double> values,
                               SplineEnds ends)
    : times_(std::move(times)), values_(std::move(values)), slopes_(times_.size(), 0.0) {
  Require(!times_.empty() && times_.size() == values_.size(),
          "a spline needs as many values as times, and at least one: got {} times, {} values",
          times_.size(), values_.size());
  std::vector<Interval> intervals;
  for (std::size_t i = 0; i + 1 < times_.size(); ++i) {
    const double width = times_[i + 1] - times_[i];
    Require(width > 0.0, "a spline's times must increase: got {} after {}", times_[i + 1],
            times_[i]);
    intervals.push_back({width, (values_[i + 1] - values_[i]) / width});
  }
  for (std::size_t i = 1; i < intervals.size(); ++i) {
    slopes_[i] = SlopeBetween(intervals[i - 1], intervals[i]);
  }
  if (ends == SplineEnds::kLooped && !intervals.empty()) {
    slopes_.front() = slopes_.back() = SlopeBetween(intervals.back(), intervals.front());
  }
}

double MonotoneSpline::At(double time) const {
  if (time <= times_.front()) return values_.front();
  if (time >= times_.back()) return values_.back();
  const auto next = std::upper_bound(times_.begin(), times_.end(), time);
  const std::size_t b = static_cast<std::size_t>(next - times_.begin()), a = b - 1;
  const double width = times_[b] - times_[a];
  const double u = (time - times_[a]) / width, v = 1.0 - u;
  // Cubic Hermite basis.
  return v * v * (1.0 + 2.0 * u) * values_[a] + u * u * (1.0 + 2.0 * v) * values_[b] +
         u * v * width * (v * slopes_[a] - u * slopes_[b]);
}

}  // namespace vitruvia
