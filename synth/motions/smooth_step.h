// A smooth step: 0 below 0, 1 above 1, with zero slope at both (3u² − 2u³ between).
#pragma once

#include <algorithm>

namespace vitruvia {

inline double SmoothStep(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

}  // namespace vitruvia
