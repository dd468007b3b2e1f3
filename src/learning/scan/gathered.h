// Numbers at eight indices.
#pragma once

#include "math/lanes.h"

namespace vitruvia {

// base[index] in each lane.
template <class Numbers, class Scalar>
Numbers Gathered(const Scalar* base, const IntLanes& index) {
  Numbers numbers;
  for (int lane = 0; lane < kLanes; ++lane) numbers[lane] = base[index[lane]];
  return numbers;
}

}  // namespace vitruvia
