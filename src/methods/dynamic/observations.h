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
  std::vector<Scalar> sums;            // x, y, z, count of each slot that is observed
  std::vector<std::uint8_t> observed;  // of each kLanes slots: a bit for each that is observed

  // Of a multiple of kLanes slots none is observed.
  void Reset(int slots) {
    sums.assign(4 * static_cast<std::size_t>(slots), Scalar(0));
    observed.assign(static_cast<std::size_t>(slots / kLanes), 0);
  }
  // The same for the slots begin … end, multiples of kLanes.
  void Clear(int begin, int end) {
    std::fill(observed.begin() + begin / kLanes, observed.begin() + end / kLanes, 0);
  }
  bool IsObserved(int slot) const { return (observed[slot / kLanes] >> (slot % kLanes) & 1) != 0; }
  Scalar Count(int slot) const {
    return IsObserved(slot) ? sums[4 * static_cast<std::size_t>(slot) + 3] : Scalar(0);
  }
  Vector3<Scalar> Mean(int slot) const {  // p̄; only of an observed slot
    const Scalar* s = &sums[4 * static_cast<std::size_t>(slot)];
    return Vector3<Scalar>(s[0], s[1], s[2]) / s[3];
  }
  void Add(int slot, const Vector3<Scalar>& point) {
    Scalar* s = &sums[4 * static_cast<std::size_t>(slot)];
    const Scalar kept = IsObserved(slot) ? Scalar(1) : Scalar(0);  // without a branch
    s[0] = kept * s[0] + point.x();
    s[1] = kept * s[1] + point.y();
    s[2] = kept * s[2] + point.z();
    s[3] = kept * s[3] + Scalar(1);
    observed[slot / kLanes] |= static_cast<std::uint8_t>(1u << (slot % kLanes));
  }
};

}  // namespace vitruvia::dynamic
