// A few indices of many.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace vitruvia {

// min(all, count) of the indices 0 … all − 1, evenly spread, the first and, of two and more, the
// last among them.
inline std::vector<int> EvenlySpread(int all, int count) {
  const int taken = std::min(all, count);
  std::vector<int> indices;
  for (int i = 0; i < taken; ++i) {
    indices.push_back(taken == 1 ? 0
                                 : static_cast<int>(std::lround(i * (all - 1.0) / (taken - 1.0))));
  }
  return indices;
}

}  // namespace vitruvia
