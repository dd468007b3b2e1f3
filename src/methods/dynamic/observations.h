// The observed points of each vertex: their sum and number.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "math/lanes.h"
#include "math/vector.h"

namespace vitruvia::dynamic {

template <class Scalar>
struct Observations {
  std::vector<Scalar> sums;            // x, y, z, count of each slot; 0 where none is observed
  std::vector<std::uint8_t> observed;  // of each kLanes slots: a bit for each that is observed

  // No slot is observed. A multiple of kLanes.
  void Reset(int slots) {
    sums.assign(4 * static_cast<std::size_t>(slots), Scalar(0));
    observed.assign(static_cast<std::size_t>(slots / kLanes), 0);
  }
  // The same for the slots begin … end, multiples of kLanes. Writes only where some are observed.
  void Clear(int begin, int end) {
    for (int slot = begin; slot < end; slot += kLanes) {
      if (observed[slot / kLanes] == 0) continue;
      observed[slot / kLanes] = 0;
      std::fill_n(&sums[4 * static_cast<std::size_t>(slot)], 4 * kLanes, Scalar(0));
    }
  }
  Scalar Count(int slot) const { return sums[4 * static_cast<std::size_t>(slot) + 3]; }
  Vector3<Scalar> Mean(int slot) const {  // p̄; only where Count is not 0
    const Scalar* s = &sums[4 * static_cast<std::size_t>(slot)];
    return Vector3<Scalar>(s[0], s[1], s[2]) / s[3];
  }
  void Add(int slot, const Vector3<Scalar>& point) {
    Scalar* s = &sums[4 * static_cast<std::size_t>(slot)];
    s[0] += point.x();
    s[1] += point.y();
    s[2] += point.z();
    s[3] += Scalar(1);
    observed[slot / kLanes] |= static_cast<std::uint8_t>(1u << (slot % kLanes));
  }
};

}  // namespace vitruvia::dynamic
