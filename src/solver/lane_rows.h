// Rows of a least squares problem that depend on the same blocks of unknowns, eight at a time.
#pragma once

#include <array>

#include "math/lanes.h"
#include "solver/block_normal_equations.h"

namespace vitruvia {

// Sums over rows that all depend on N blocks, N ≤ kMaxRowBlocks, lane by lane.
template <int N, class Scalar>
class LaneRows {
 public:
  using Numbers = Lanes<Scalar>;
  static constexpr int kRow = kBlockSize * N;
  using Row = std::array<Numbers, kRow>;

  // Eight rows: their Jacobian, and Jacobian and residual times the weight.
  void Add(const Row& jacobian, const Numbers& residual, const Row& weighted_jacobian,
           const Numbers& weighted_residual) {
    energy_ += weighted_residual * residual;
    int entry = 0;
    for (int a = 0; a < kRow; ++a) {
      gradient_[a] += weighted_jacobian[a] * residual;
      for (int b = a; b < kRow; ++b) hessian_[entry++] += weighted_jacobian[a] * jacobian[b];
    }
  }

  RowSums Sums() const {
    RowSums sums;
    for (std::size_t i = 0; i < hessian_.size(); ++i)
      sums.hessian[i] = double{SumOfLanes(hessian_[i])};
    for (std::size_t i = 0; i < gradient_.size(); ++i)
      sums.gradient[i] = double{SumOfLanes(gradient_[i])};
    sums.energy = double{SumOfLanes(energy_)};
    return sums;
  }

 private:
  std::array<Numbers, kRow*(kRow + 1) / 2> hessian_{};
  Row gradient_{};
  Numbers energy_{};
};

}  // namespace vitruvia
