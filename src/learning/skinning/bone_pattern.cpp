#include "learning/skinning/bone_pattern.h"

#include <Eigen/Cholesky>

namespace vitruvia::skinning {

BonePattern::BonePattern(int bones) : bone_at_(bones), slots_(bones * bones) {}

void BonePattern::Analyse(const Eigen::MatrixXd& second) {
  const int n = bones();
  std::vector<char> coupled(n * n);
  for (int a = 0; a < n; ++a) {
    for (int b = 0; b < n; ++b) coupled[a * n + b] = a == b || second(4 * a + 3, 4 * b + 3) > 0.0;
  }
  Order(coupled);
}

// Minimum-degree ordering: eliminates the bone with the fewest remaining couplings, and couples its
// neighbours to each other.
void BonePattern::Order(const std::vector<char>& coupled) {
  const int n = bones();
  std::vector<char> graph = coupled;
  std::vector<char> left(n, 1);
  std::fill(slots_.begin(), slots_.end(), 0);
  std::vector<int> place_of(n);
  for (int place = 0; place < n; ++place) {
    int chosen = -1, fewest = n + 1;
    for (int bone = 0; bone < n; ++bone) {
      if (!left[bone]) continue;
      int degree = 0;
      for (int other = 0; other < n; ++other) degree += left[other] & graph[bone * n + other];
      if (degree < fewest) {
        fewest = degree;
        chosen = bone;
      }
    }
    bone_at_[place] = chosen;
    place_of[chosen] = place;
    left[chosen] = 0;
    for (int a = 0; a < n; ++a) {
      for (int b = 0; b < n; ++b) {
        if (left[a] && left[b] && graph[chosen * n + a] && graph[chosen * n + b]) {
          graph[a * n + b] = 1;
        }
      }
    }
  }
  blocks_ = 0;
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column <= row; ++column) {
      const bool present = graph[bone_at_[row] * n + bone_at_[column]] != 0;
      slots_[row * n + column] = present ? blocks_++ : -1;
    }
  }
}

bool BoneCholesky::Factor(const BonePattern& pattern, const std::vector<Matrix6>& matrix) {
  const int n = pattern.bones();
  lower_ = matrix;
  for (int column = 0; column < n; ++column) {
    for (int k = 0; k < column; ++k) {
      const int left = pattern.Slot(column, k);
      if (left < 0) continue;
      for (int row = column; row < n; ++row) {
        const int below = pattern.Slot(row, k);
        if (below < 0) continue;
        lower_[pattern.Slot(row, column)].noalias() -= lower_[below] * lower_[left].transpose();
      }
    }
    Matrix6& diagonal = lower_[pattern.Slot(column, column)];
    const Eigen::LLT<Matrix6> cholesky(diagonal);
    if (cholesky.info() != Eigen::Success) return false;
    diagonal.setIdentity();
    cholesky.matrixL().solveInPlace(diagonal);
    for (int row = column + 1; row < n; ++row) {
      const int slot = pattern.Slot(row, column);
      if (slot >= 0) lower_[slot] = (lower_[slot] * diagonal.transpose()).eval();
    }
  }
  return true;
}

void BoneCholesky::SolveInPlace(const BonePattern& pattern, Eigen::Ref<Eigen::VectorXd> x) const {
  const int n = pattern.bones();
  for (int row = 0; row < n; ++row) {
    auto own = x.segment<6>(6 * pattern.BoneAt(row));
    for (int column = 0; column < row; ++column) {
      const int slot = pattern.Slot(row, column);
      if (slot >= 0) own -= lower_[slot] * x.segment<6>(6 * pattern.BoneAt(column));
    }
    own = (lower_[pattern.Slot(row, row)] * own).eval();
  }
  for (int row = n - 1; row >= 0; --row) {
    auto own = x.segment<6>(6 * pattern.BoneAt(row));
    own = (lower_[pattern.Slot(row, row)].transpose() * own).eval();
    for (int column = 0; column < row; ++column) {
      const int slot = pattern.Slot(row, column);
      if (slot >= 0) x.segment<6>(6 * pattern.BoneAt(column)) -= lower_[slot].transpose() * own;
    }
  }
}

}  // namespace vitruvia::skinning
