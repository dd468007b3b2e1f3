// Weights of one vertex: the least squares over the simplex, with few of them non-zero.
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

// The least value with only candidates of the bit set `allowed` non-zero (at least one), however
// many. `w` is where the search starts: on the simplex and within `allowed`.
void MinimizeOnSimplex(const SimplexQp& qp, std::uint32_t allowed, CandidateWeights& w);

// The least value with at most `most` non-zero weights: exact, by branch and bound over which
// candidates are left out; the bound is the least value without the limit. `w` is where the search
// starts, on the simplex; its value is never exceeded if it keeps the limit. Weights that cannot be
// told apart within the problem's precision stay close to where they started.
void MinimizeSparseOnSimplex(const SimplexQp& qp, int most, CandidateWeights& w);

}  // namespace vitruvia::skinning
