// The sparsity pattern of bones that share vertices, and a Cholesky decomposition that exploits it.
//
// The decomposition works on blocks of 6 × 6. Eigen::SimplicialLLT with one symbolic analysis,
// which works on single entries, takes 3 times as long to factor and 4 times as long to solve for
// the body's 17 bones; the solutions agree within 1e-15.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace vitruvia::skinning {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

// The non-zero blocks of a symmetric matrix over bones, and the fill-in of its decomposition, with
// bones eliminated in an order of little fill-in. Trees like a body's skeleton have hardly any.
class BonePattern {
 public:
  explicit BonePattern(int bones);

  // Bones are coupled if vertices follow both: `second` is that of SkinMoments.
  void Analyse(const Eigen::MatrixXd& second);

  int bones() const { return static_cast<int>(bone_at_.size()); }
  int blocks() const { return blocks_; }
  int BoneAt(int place) const { return bone_at_[place]; }  // in the order of elimination
  // Index of the block of two places in the elimination order, row ≥ column; -1 if it is zero.
  int Slot(int row, int column) const { return slots_[row * bones() + column]; }

 private:
  void Order(const std::vector<char>& coupled);

  int blocks_ = 0;
  std::vector<int> bone_at_, slots_;
};

// L Lᵀ of a symmetric positive definite matrix of 6 × 6 blocks with that pattern.
class BoneCholesky {
 public:
  // The lower blocks, in the slots of `pattern`. False if the matrix is not positive definite.
  bool Factor(const BonePattern& pattern, const std::vector<Matrix6>& matrix);
  // Bone by bone six entries, in the bones' own order.
  void SolveInPlace(const BonePattern& pattern, Eigen::Ref<Eigen::VectorXd> x) const;

 private:
  std::vector<Matrix6> lower_;  // L, with the inverses of its blocks on the diagonal
};

}  // namespace vitruvia::skinning
