// SIMD vectors of eight numbers (and of four and two), by the vector extension of GCC and Clang,
// whose operators work lane by lane. A comparison gives 0 or −1 in each lane, and `mask ? a : b`
// selects lane by lane; Eigen 3.4 does not vectorise such a selection.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#ifdef __AVX__
#include <immintrin.h>
#endif

// Eight doubles fill two registers, so compilers warn that a program with AVX-512 would return them
// in another way. All files of a program are compiled for the same instructions.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace vitruvia {

inline constexpr int kLanes = 8;
using FloatLanes = float __attribute__((vector_size(sizeof(float) * kLanes)));
using DoubleLanes = double __attribute__((vector_size(sizeof(double) * kLanes)));
using FloatQuad = float __attribute__((vector_size(sizeof(float) * 4)));
using DoublePair = double __attribute__((vector_size(sizeof(double) * 2)));
using DoubleQuad = double __attribute__((vector_size(sizeof(double) * 4)));
using IntLanes = std::int32_t __attribute__((vector_size(sizeof(std::int32_t) * kLanes)));

// The lanes of a kind of number that a template takes.
template <class Scalar>
struct LanesOf;
template <>
struct LanesOf<float> {
  using Type = FloatLanes;
};
template <>
struct LanesOf<double> {
  using Type = DoubleLanes;
};
template <class Scalar>
using Lanes = typename LanesOf<Scalar>::Type;

inline FloatLanes Min(FloatLanes a, FloatLanes b) { return a < b ? a : b; }
inline FloatLanes Max(FloatLanes a, FloatLanes b) { return a > b ? a : b; }
inline FloatLanes Abs(FloatLanes x) { return Max(x, -x); }
inline FloatLanes Sqrt(FloatLanes x) {
#ifdef __AVX__
  return reinterpret_cast<FloatLanes>(_mm256_sqrt_ps(reinterpret_cast<__m256>(x)));
#else
  for (int lane = 0; lane < kLanes; ++lane) x[lane] = std::sqrt(x[lane]);
  return x;
#endif
}

// The next three functions need numbers that fit an int.
inline IntLanes Truncate(FloatLanes x) { return __builtin_convertvector(x, IntLanes); }
inline FloatLanes Floor(FloatLanes x) {
#ifdef __AVX__
  return _mm256_floor_ps(x);
#else
  const FloatLanes truncated = __builtin_convertvector(Truncate(x), FloatLanes);
  return truncated > x ? truncated - 1.0f : truncated;
#endif
}
inline FloatLanes Ceil(FloatLanes x) {
#ifdef __AVX__
  return _mm256_ceil_ps(x);
#else
  const FloatLanes truncated = __builtin_convertvector(Truncate(x), FloatLanes);
  return truncated < x ? truncated + 1.0f : truncated;
#endif
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

// The lanes of each possible result of Bits that are set, ascending.
inline constexpr auto kLanesOfBits = [] {
  std::array<std::array<std::uint8_t, kLanes>, 1 << kLanes> lanes_of_bits{};
  for (unsigned bits = 0; bits < lanes_of_bits.size(); ++bits) {
    std::size_t count = 0;
    for (std::uint8_t lane = 0; lane < kLanes; ++lane) {
      if ((bits >> lane & 1u) != 0) lanes_of_bits[bits][count++] = lane;
    }
  }
  return lanes_of_bits;
}();

// The numbers at these eight indices, in an IntLanes or an array.
template <class Scalar, class Indices>
[[gnu::always_inline]] inline Lanes<Scalar> Gather(const Scalar* numbers, const Indices& indices) {
  return Lanes<Scalar>{numbers[indices[0]], numbers[indices[1]], numbers[indices[2]],
                       numbers[indices[3]], numbers[indices[4]], numbers[indices[5]],
                       numbers[indices[6]], numbers[indices[7]]};
}

// Writes the lanes in which the mask is set one after the other, and further ones behind them: `to`
// needs room for eight. Returns how many are set. Without branches, to avoid mispredictions.
template <class Number>
std::size_t Compress(const Number& numbers, IntLanes mask, void* to) {
  const unsigned bits = Bits(mask);
  const std::array<std::uint8_t, kLanes>& lanes = kLanesOfBits[bits];
#ifdef __AVX2__
  std::int64_t packed;
  std::memcpy(&packed, lanes.data(), sizeof packed);
  const __m256i order = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(packed));
  const auto compressed = _mm256_permutevar8x32_epi32(reinterpret_cast<__m256i>(numbers), order);
#else
  Number compressed{};
  for (int lane = 0; lane < kLanes; ++lane) compressed[lane] = numbers[lanes[lane]];
#endif
  std::memcpy(to, &compressed, sizeof compressed);
  return static_cast<std::size_t>(std::popcount(bits));
}

// first, first + 1, … first + 7.
inline IntLanes CountFrom(int first) { return IntLanes{0, 1, 2, 3, 4, 5, 6, 7} + first; }

template <class Number>
auto SmallestLane(const Number& v) {
  const auto least = [](const Number& a, const Number& b) { return a < b ? a : b; };
  const Number four = least(v, __builtin_shufflevector(v, v, 4, 5, 6, 7, 0, 1, 2, 3));
  const Number two = least(four, __builtin_shufflevector(four, four, 2, 3, 0, 1, 6, 7, 4, 5));
  return least(two, __builtin_shufflevector(two, two, 1, 0, 3, 2, 5, 4, 7, 6))[0];
}

// Whether a mask is set in any lane.
template <class Mask>
bool Any(const Mask& mask) {
  return SmallestLane(mask) != 0;
}

// Whether one of eight numbers is positive.
inline bool IsAnyPositive(const float* numbers) {
  FloatLanes lanes;
  std::memcpy(&lanes, numbers, sizeof lanes);
  return Bits(lanes > 0.0f) != 0;
}

// In pairs of four, of two and of one apart.
template <class Number>
auto SumOfLanes(const Number& v) {
  const Number four = v + __builtin_shufflevector(v, v, 4, 5, 6, 7, 0, 1, 2, 3);
  const Number two = four + __builtin_shufflevector(four, four, 2, 3, 0, 1, 6, 7, 4, 5);
  return (two + __builtin_shufflevector(two, two, 1, 0, 3, 2, 5, 4, 7, 6))[0];
}

// The eight numbers of a column that begin at index `first`.
template <class Number, class Scalar>
Number LoadLanes(const std::vector<Scalar>& column, int first) {
  Number lanes;
  std::memcpy(&lanes, &column[first], sizeof lanes);
  return lanes;
}

// Writes them there.
template <class Number, class Scalar>
void StoreLanes(const Number& lanes, int first, std::vector<Scalar>& column) {
  std::memcpy(&column[first], &lanes, sizeof lanes);
}

// The coordinates of eight points.
struct PointLanes {
  FloatLanes x, y, z;
};

// Of points that lie side by side, three numbers each.
inline PointLanes LoadPoints(const float* xyz) {
  FloatLanes a, b, c;  // x y z x y z x y | z x y z x y z x | y z x y z x y z
  std::memcpy(&a, xyz, sizeof a);
  std::memcpy(&b, xyz + kLanes, sizeof b);
  std::memcpy(&c, xyz + 2 * kLanes, sizeof c);
  const FloatLanes x = __builtin_shufflevector(a, b, 0, 3, 6, 9, 12, 15, 0, 0);
  const FloatLanes y = __builtin_shufflevector(a, b, 1, 4, 7, 10, 13, 0, 0, 0);
  const FloatLanes z = __builtin_shufflevector(a, b, 2, 5, 8, 11, 14, 0, 0, 0);
  return {__builtin_shufflevector(x, c, 0, 1, 2, 3, 4, 5, 10, 13),
          __builtin_shufflevector(y, c, 0, 1, 2, 3, 4, 8, 11, 14),
          __builtin_shufflevector(z, c, 0, 1, 2, 3, 4, 9, 12, 15)};
}

// Of the points at these indices.
inline PointLanes GatherPoints(const float* xyz, const IntLanes& indices) {
  const IntLanes first = 3 * indices;
  return {Gather(xyz, first), Gather(xyz + 1, first), Gather(xyz + 2, first)};
}

}  // namespace vitruvia
