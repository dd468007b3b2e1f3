#include "solver/block_normal_equations.h"

#include <algorithm>
#include <cstring>

#include "math/lanes.h"

namespace vitruvia {
namespace {

// A column of six numbers in two registers.
struct SixLanes {
  DoubleQuad upper;
  DoublePair lower;

  explicit SixLanes(const double* numbers) {
    std::memcpy(&upper, numbers, sizeof upper);
    std::memcpy(&lower, numbers + 4, sizeof lower);
  }
  SixLanes& operator*=(double factor) {
    upper *= factor;
    lower *= factor;
    return *this;
  }
};

template <class Lanes>
void AddTo(double* numbers, const Lanes& addend) {
  Lanes sum;
  std::memcpy(&sum, numbers, sizeof sum);
  sum += addend;
  std::memcpy(numbers, &sum, sizeof sum);
}

void AddProduct(const SixLanes& column, double factor, double* sum) {
  AddTo(sum, column.upper * factor);
  AddTo(sum + 4, column.lower * factor);
}

// `block` is the first number of a 6×6 block whose columns are `stride` apart.
void AddOuterProduct(const SixLanes& column, const double* row, double* block,
                     Eigen::Index stride) {
  for (int j = 0; j < kBlockSize; ++j) AddProduct(column, row[j], block + j * stride);
}

// The same, but of what lies below the diagonal only as much as shares a register.
void AddUpperOuterProduct(const SixLanes& column, const double* row, double* block,
                          Eigen::Index stride) {
  const DoublePair first = __builtin_shufflevector(column.upper, column.upper, 0, 1);
  for (int j = 0; j < 2; ++j) AddTo(block + j * stride, first * row[j]);
  for (int j = 2; j < 4; ++j) AddTo(block + j * stride, column.upper * row[j]);
  for (int j = 4; j < kBlockSize; ++j) AddProduct(column, row[j], block + j * stride);
}

}  // namespace

BlockNormalEquations::BlockNormalEquations(int blocks)
    : hessian_(Eigen::MatrixXd::Zero(blocks * kBlockSize, blocks * kBlockSize)),
      gradient_(Eigen::VectorXd::Zero(blocks * kBlockSize)) {}

void BlockNormalEquations::Reset() {
  hessian_.setZero();
  gradient_.setZero();
  energy_ = 0.0;
}

void BlockNormalEquations::AddRow(std::span<const Entry> entries, double residual, double weight) {
  const Eigen::Index stride = hessian_.rows();
  for (const Entry& a : entries) {
    SixLanes weighted(a.jacobian.data());
    weighted *= weight;
    const int row = a.block * kBlockSize;
    AddProduct(weighted, residual, &gradient_[row]);
    for (const Entry& b : entries) {
      if (b.block < a.block) continue;
      double* block = &hessian_(row, b.block * kBlockSize);
      if (b.block == a.block) {
        AddUpperOuterProduct(weighted, b.jacobian.data(), block, stride);
      } else {
        AddOuterProduct(weighted, b.jacobian.data(), block, stride);
      }
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

// Block after block, since the columns of the whole matrix do not fit the nearest cache.
void BlockNormalEquations::Symmetrize() {
  for (int a = 0; a < hessian_.cols(); a += kBlockSize) {
    auto diagonal = hessian_.block<kBlockSize, kBlockSize>(a, a);
    diagonal.triangularView<Eigen::StrictlyLower>() = diagonal.transpose();
    for (int b = a + kBlockSize; b < hessian_.cols(); b += kBlockSize) {
      hessian_.block<kBlockSize, kBlockSize>(b, a) =
          hessian_.block<kBlockSize, kBlockSize>(a, b).transpose();
    }
  }
}

}  // namespace vitruvia
