// Normal equations of a linear least squares problem whose unknowns come in blocks of six, such as
// one rigid increment for each bone.
#pragma once

#include <array>
#include <span>

#include <Eigen/Core>

namespace vitruvia {

inline constexpr int kBlockSize = 6;
using Vector6d = Eigen::Matrix<double, kBlockSize, 1>;

// Sums over rows that depend on the same blocks.
inline constexpr int kMaxRowBlocks = 4;
struct RowSums {
  static constexpr int kMaxRow = kBlockSize * kMaxRowBlocks;
  std::array<double, kMaxRow*(kMaxRow + 1) / 2> hessian;  // upper triangle of JᵀWJ, row after row
  std::array<double, kMaxRow> gradient;                   // JᵀWr
  double energy = 0.0;                                    // rᵀWr
};

// Σ_rows weight · (residual + Σ_k jacobian_k · x_block_k)², accumulated as H x = −g.
class BlockNormalEquations {
 public:
  explicit BlockNormalEquations(int blocks);

  void Reset();

  struct Entry {
    int block;
    Vector6d jacobian;
  };
  // A row must not contain a block twice.
  void AddRow(std::span<const Entry> entries, double residual, double weight);

  // The same for many rows at once: unknown i of `sums` is unknown i % 6 of blocks[i / 6].
  void AddRows(std::span<const int> blocks, const RowSums& sums);

  // Adds value to every diagonal element: keeps unobserved unknowns where they are.
  void AddDamping(double value);

  // After the last row: the lower triangle becomes the mirror of the upper one.
  void Symmetrize();

  const Eigen::MatrixXd& hessian() const { return hessian_; }    // H = JᵀWJ
  const Eigen::VectorXd& gradient() const { return gradient_; }  // g = JᵀWr
  double energy() const { return energy_; }                      // rᵀWr at x = 0
  int size() const { return static_cast<int>(gradient_.size()); }

 private:
  Eigen::MatrixXd hessian_;
  Eigen::VectorXd gradient_;
  double energy_ = 0.0;
};

}  // namespace vitruvia
