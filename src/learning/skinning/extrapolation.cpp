#include "learning/skinning/extrapolation.h"

#include <algorithm>

#include <Eigen/Cholesky>

namespace vitruvia::skinning {
namespace {

constexpr double kRelativeDamping = 1e-10;  // of the least squares over the history

}  // namespace

Extrapolation::Extrapolation(int bones, int poses, int history)
    : history_(history),
      afters_(history + 1, BoneStack(4 * bones, 3 * poses)),
      residuals_(history + 1, BoneStack(4 * bones, 3 * poses)),
      moved_(4 * bones, 3 * poses),
      difference_(4 * bones, 3 * poses) {}

bool Extrapolation::Extrapolate(const BoneStack& before, const BoneStack& after,
                                const Eigen::MatrixXd& second, BoneStack& next) {
  const int slots = history_ + 1, latest = count_ % slots;
  afters_[latest] = after;
  residuals_[latest] = after - before;
  ++count_;
  next = after;
  const int pairs = std::min(count_, slots) - 1;  // older ones
  if (pairs < 1) return false;

  Eigen::MatrixXd normal(pairs, pairs);
  Eigen::VectorXd right(pairs);
  for (int i = 0; i < pairs; ++i) {
    difference_ = residuals_[latest] - residuals_[(count_ - 2 - i) % slots];
    moved_.noalias() = second * difference_;
    right[i] = moved_.cwiseProduct(residuals_[latest]).sum();
    for (int j = 0; j <= i; ++j) {
      normal(i, j) = normal(j, i) =
          moved_.cwiseProduct(residuals_[latest] - residuals_[(count_ - 2 - j) % slots]).sum();
    }
  }
  normal.diagonal() *= 1.0 + kRelativeDamping;
  normal.diagonal().array() += 1e-300;
  const Eigen::VectorXd shares = normal.ldlt().solve(right);
  if (!shares.allFinite()) return false;
  for (int i = 0; i < pairs; ++i) {
    next -= shares[i] * (afters_[latest] - afters_[(count_ - 2 - i) % slots]);
  }
  return true;
}

}  // namespace vitruvia::skinning
