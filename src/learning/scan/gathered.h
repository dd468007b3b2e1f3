// Numbers at eight indices.
#pragma once

#include <cstdint>

#include "math/lanes.h"

namespace vitruvia {

// base[index] in each lane.
inline FloatLanes Gathered(const float* base, const IntLanes& index) {
#ifdef __AVX2__
  const auto all = reinterpret_cast<__m256>(IntLanes{} - 1);
  return _mm256_mask_i32gather_ps(__m256{}, base, reinterpret_cast<__m256i>(index), all,
                                  sizeof(float));
#else
  return Gather(base, index);
#endif
}
inline IntLanes Gathered(const std::int32_t* base, const IntLanes& index) {
#ifdef __AVX2__
  const auto all = reinterpret_cast<__m256i>(IntLanes{} - 1);
  return reinterpret_cast<IntLanes>(_mm256_mask_i32gather_epi32(
      __m256i{}, base, reinterpret_cast<__m256i>(index), all, sizeof(std::int32_t)));
#else
  return IntLanes{base[index[0]], base[index[1]], base[index[2]], base[index[3]],
                  base[index[4]], base[index[5]], base[index[6]], base[index[7]]};
#endif
}

// Two numbers that lie side by side, in each lane.
struct PairLanes {
  FloatLanes first, second;
};

// pairs[2 index] and pairs[2 index + 1] in each lane.
inline PairLanes GatheredPairs(const float* pairs, const IntLanes& index) {
#ifdef __AVX2__
  const auto indices = reinterpret_cast<__m256i>(index);
  const auto four = [&](__m128i chosen) {
    const auto all = reinterpret_cast<__m256d>(IntLanes{} - 1);
    return reinterpret_cast<FloatLanes>(_mm256_mask_i32gather_pd(
        __m256d{}, reinterpret_cast<const double*>(pairs), chosen, all, sizeof(double)));
  };
  const FloatLanes a = four(_mm256_castsi256_si128(indices));
  const FloatLanes b = four(_mm256_extracti128_si256(indices, 1));
  return {__builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14),
          __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15)};
#else
  return {Gather(pairs, 2 * index), Gather(pairs + 1, 2 * index)};
#endif
}

}  // namespace vitruvia
