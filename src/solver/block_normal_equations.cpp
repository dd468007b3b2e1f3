#include "solver/block_normal_equations.h"

#include <algorithm>

namespace vitruvia {

BlockNormalEquations::BlockNormalEquations(int blocks)
    : hessian_(Eigen::MatrixXd::Zero(blocks * kBlockSize, blocks * kBlockSize)),
      gradient_(Eigen::VectorXd::Zero(blocks * kBlockSize)) {}

void BlockNormalEquations::Reset() {
  hessian_.setZero();
  gradient_.setZero();
  energy_ = 0.0;
}

void BlockNormalEquations::AddRow(std::span<const Entry> entries, double residual, double weight) {
  for (const Entry& a : entries) {
    const Vector6d weighted = weight * a.jacobian;
    const int row = a.block * kBlockSize;
    gradient_.segment<kBlockSize>(row) += residual * weighted;
    for (const Entry& b : entries) {
      if (b.block < a.block) continue;
      hessian_.block<kBlockSize, kBlockSize>(row, b.block * kBlockSize).noalias() +=
          weighted * b.jacobian.transpose();
    }
  }
  energy_ += weight * residual * residual;
}

void BlockNormalEquations::AddRows(std::span<const int> blocks, const RowSums& sums) {
  const int size = kBlockSize * static_cast<int>(blocks.size());
  const auto unknown = [&](int i) { return kBlockSize * blocks[i / kBlockSize] + i % kBlockSize; };
  int entry = 0;
  for (int a = 0; a < size; ++a) {
    const int row = unknown(a);
    gradient_[row] += sums.gradient[a];
    for (int b = a; b < size; ++b) {
      const int column = unknown(b);
      hessian_(std::min(row, column), std::max(row, column)) += sums.hessian[entry++];
    }
  }
  energy_ += sums.energy;
}

void BlockNormalEquations::AddDamping(double value) { hessian_.diagonal().array() += value; }

void BlockNormalEquations::Symmetrize() {
  hessian_.triangularView<Eigen::StrictlyLower>() = hessian_.transpose();
}

}  // namespace vitruvia
