// Normal equations of a linear least squares problem whose unknowns come in blocks of six, such as
// one rigid increment for each bone.
#pragma once

#include <span>

#include <Eigen/Core>

namespace vitruvia {

inline constexpr int kBlockSize = 6;
using Vector6d = Eigen::Matrix<double, kBlockSize, 1>;

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
