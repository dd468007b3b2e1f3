// Interpolation of one quantity over key frames: the monotone cubic of M. Steffen, "A simple method
// for monotonic interpolation in one dimension", Astronomy & Astrophysics 239 (1990).
//
// Continuously differentiable, passes through the values, and never leaves the range of the two
// neighbouring ones: joint angles within their limits at the key frames are so in between as well.
#pragma once

#include <vector>

namespace vitruvia {

enum class SplineEnds {
  kAtRest,  // the derivative is zero at both ends
  kLooped,  // the last value carries on as the first, up to a constant
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
