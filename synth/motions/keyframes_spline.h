// Interpolation of one quantity over key frames: the monotone cubic of M. Steffen, "A simple method
// for monotonic interpolation in one dimension", Astronomy & Astrophysics 239 (1990).
//
// Continuously differentiable, passes through the values, and never leaves the range of the two
// neighbouring ones: joint angles that are within their limits at the key frames are also within
// them in between.
#pragma once

#include <vector>

namespace vitruvia {

enum class SplineEnds {
  kAtRest,  // the derivative is zero at both ends
  kLooped,  // periodic up to a constant: the last value continues as the first
};

class MonotoneSpline {
 public:
  // At least one point, times increasing.
  MonotoneSpline(std::vector<double> times, std::vector<double> values, SplineEnds ends);

  double At(double time) const;  // held at the ends

 private:
  std::vector<double> times_, values_, slopes_;
};

}  // namespace vitruvia
