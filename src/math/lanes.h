// SIMD vectors of eight numbers, by the vector extension of GCC and Clang, whose operators work
// lane by lane. A comparison gives 0 or −1 in each lane, and `mask ? a : b` selects lane by lane;
// Eigen 3.4 does not vectorise such a selection.
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#ifdef __AVX__
#include <immintrin.h>
#endif

namespace vitruvia {

inline constexpr int kLanes = 8;
using FloatLanes = float __attribute__((vector_size(sizeof(float) * kLanes)));
using IntLanes = std::int32_t __attribute__((vector_size(sizeof(std::int32_t) * kLanes)));

inline FloatLanes Min(FloatLanes a, FloatLanes b) { return a < b ? a : b; }
inline FloatLanes Max(FloatLanes a, FloatLanes b) { return a > b ? a : b; }

// The next three functions need numbers that fit an int.
inline IntLanes Truncate(FloatLanes x) { return __builtin_convertvector(x, IntLanes); }
inline FloatLanes Floor(FloatLanes x) {
  const FloatLanes truncated = __builtin_convertvector(Truncate(x), FloatLanes);
  return truncated > x ? truncated - 1.0f : truncated;
}
inline FloatLanes Ceil(FloatLanes x) {
  const FloatLanes truncated = __builtin_convertvector(Truncate(x), FloatLanes);
  return truncated < x ? truncated + 1.0f : truncated;
}

// One bit for each lane in which the mask is set, lane 0 the lowest.
inline unsigned Bits(IntLanes mask) {
#ifdef __AVX__
  return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask)));
#else
  unsigned bits = 0;
  for (int lane = 0; lane < kLanes; ++lane) bits |= mask[lane] != 0 ? 1u << lane : 0u;
  return bits;
#endif
}

template <class Lanes>
auto SmallestLane(const Lanes& v) {
  const auto least = [](const Lanes& a, const Lanes& b) { return a < b ? a : b; };
  const Lanes four = least(v, __builtin_shufflevector(v, v, 4, 5, 6, 7, 0, 1, 2, 3));
  const Lanes two = least(four, __builtin_shufflevector(four, four, 2, 3, 0, 1, 6, 7, 4, 5));
  return least(two, __builtin_shufflevector(two, two, 1, 0, 3, 2, 5, 4, 7, 6))[0];
}

// The eight numbers of a column that begin at index `first`.
template <class Lanes, class Scalar>
Lanes LoadLanes(const std::vector<Scalar>& column, int first) {
  Lanes lanes;
  std::memcpy(&lanes, &column[first], sizeof lanes);
  return lanes;
}

}  // namespace vitruvia
