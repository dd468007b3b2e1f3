// Weights of one vertex: least squares over the simplex with a limited number of non-zero weights.
#pragma once

#include <array>
#include <cstdint>

#include "body/skinning.h"

namespace vitruvia::skinning {

inline constexpr int kMaxCandidates = 20;  // bones that one vertex may choose from

// wᵀ G w − 2 cᵀ w over w ≥ 0, Σ w = 1. G is symmetric and positive semidefinite; only the first
// `size` rows and columns count.
struct SimplexQp {
  int size = 0;
  std::array<std::array<double, kMaxCandidates>, kMaxCandidates> gram;
  std::array<double, kMaxCandidates> target;

  double Value(const std::array<double, kMaxCandidates>& w) const;
};

using CandidateWeights = std::array<double, kMaxCandidates>;

// Minimises over weights that are non-zero only for candidates of the bit set `allowed` (at least
// one), without a limit on their number. `w` is the start, on the simplex and within `allowed`.
void MinimizeOnSimplex(const SimplexQp& qp, std::uint32_t allowed, CandidateWeights& w);

// Minimises over weights of which at most `most` are non-zero: exact, by branch and bound over the
// candidates that are left out; the bound is the minimum without the limit. `w` is the start, on
// the simplex; if it satisfies the limit, the result is never worse. Weights that the problem's
// precision does not determine stay close to the start.
void MinimizeSparseOnSimplex(const SimplexQp& qp, int most, CandidateWeights& w);

}  // namespace vitruvia::skinning
