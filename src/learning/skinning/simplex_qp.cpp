#include "learning/skinning/simplex_qp.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace vitruvia::skinning {
namespace {

// Pulls at the start, relative to G's diagonal: far below what any bone's motion contributes, above
// the rounding of G. Keeps bones that move alike from having arbitrary shares.
constexpr double kProximal = 1e-11;
// A bone enters if the value's slope towards it is steeper than this, relative to G's diagonal.
constexpr double kSlopeTolerance = 1e-13;
// Weights below are zero.
constexpr double kLeastWeight = 1e-9;

double LargestDiagonal(const SimplexQp& qp) {
  double largest = 0.0;
  for (int j = 0; j < qp.size; ++j) largest = std::max(largest, qp.gram[j][j]);
  return largest;
}

// The candidates that are free, and the least value over their sum-one hyperplane.
class FreeSet {
 public:
  explicit FreeSet(const SimplexQp& qp) : qp_(qp) {}

  int size() const { return size_; }
  int operator[](int i) const { return members_[i]; }
  void Add(int candidate) { members_[size_++] = candidate; }
  void RemoveAt(int i) { members_[i] = members_[--size_]; }

  // Solves for the weights of the members; false if the problem is singular.
  bool Solve(std::array<double, kMaxCandidates>& solution);

 private:
  const SimplexQp& qp_;
  int size_ = 0;
  std::array<int, kMaxCandidates> members_;
};

// The last member's weight is 1 less the others', whose normal equations a Cholesky decomposition
// solves.
bool FreeSet::Solve(std::array<double, kMaxCandidates>& solution) {
  const int n = size_ - 1, last = members_[n];
  double lower[kMaxCandidates][kMaxCandidates];
  double x[kMaxCandidates];
  for (int i = 0; i < n; ++i) {
    const int a = members_[i];
    for (int j = 0; j <= i; ++j) {
      const int b = members_[j];
      double entry = qp_.gram[a][b] - qp_.gram[a][last] - qp_.gram[last][b] + qp_.gram[last][last];
      for (int k = 0; k < j; ++k) entry -= lower[i][k] * lower[j][k];
      if (i == j) {
        if (!(entry > 0.0)) return false;
        lower[i][i] = std::sqrt(entry);
      } else {
        lower[i][j] = entry / lower[j][j];
      }
    }
    double right = qp_.target[a] - qp_.target[last] - qp_.gram[a][last] + qp_.gram[last][last];
    for (int k = 0; k < i; ++k) right -= lower[i][k] * x[k];
    x[i] = right / lower[i][i];
  }
  double sum = 0.0;
  for (int i = n - 1; i >= 0; --i) {
    for (int k = i + 1; k < n; ++k) x[i] -= lower[k][i] * x[k];
    x[i] /= lower[i][i];
    solution[i] = x[i];
    sum += x[i];
  }
  solution[n] = 1.0 - sum;
  return true;
}

// Walks from w towards the members' solution until a weight is zero; drops that one. True if the
// solution itself was reached.
bool StepToSolution(FreeSet& free, const std::array<double, kMaxCandidates>& solution,
                    CandidateWeights& w) {
  double step = 1.0;
  int blocking = -1;
  for (int i = 0; i < free.size(); ++i) {
    if (solution[i] > 0.0) continue;
    const double from = w[free[i]];
    const double reach = from > 0.0 ? from / (from - solution[i]) : 0.0;
    if (blocking < 0 || reach < step) {
      step = reach;
      blocking = i;
    }
  }
  for (int i = 0; i < free.size(); ++i) w[free[i]] += step * (solution[i] - w[free[i]]);
  if (blocking < 0) return true;
  w[free[blocking]] = 0.0;
  free.RemoveAt(blocking);
  return false;
}

// The allowed candidate that is not free and lowers the value most steeply, or -1.
int SteepestCandidate(const SimplexQp& qp, std::uint32_t allowed, const FreeSet& free,
                      const CandidateWeights& w, double tolerance) {
  std::uint32_t is_free = 0;
  for (int i = 0; i < free.size(); ++i) is_free |= 1u << free[i];
  CandidateWeights slope{};
  for (int j = 0; j < qp.size; ++j) {
    slope[j] = -qp.target[j];
    for (int i = 0; i < free.size(); ++i) slope[j] += qp.gram[j][free[i]] * w[free[i]];
  }
  double level = 0.0;  // the slope that all free ones share, weighted by how well it is known
  for (int i = 0; i < free.size(); ++i) level += w[free[i]] * slope[free[i]];
  int steepest = -1;
  double least = level - tolerance;
  for (int j = 0; j < qp.size; ++j) {
    if ((allowed >> j & 1u) == 0 || (is_free >> j & 1u) != 0 || slope[j] >= least) continue;
    least = slope[j];
    steepest = j;
  }
  return steepest;
}

// Zeroes what is negligible and makes the sum one again.
void CleanUp(int size, CandidateWeights& w) {
  double sum = 0.0;
  for (int j = 0; j < size; ++j) {
    if (w[j] < kLeastWeight) w[j] = 0.0;
    sum += w[j];
  }
  for (int j = 0; j < size; ++j) w[j] /= sum;
}

std::uint32_t Support(int size, const CandidateWeights& w) {
  std::uint32_t support = 0;
  for (int j = 0; j < size; ++j) support |= w[j] > 0.0 ? 1u << j : 0u;
  return support;
}

// w with only the candidates of `kept`, of which it must have one.
CandidateWeights Restricted(int size, const CandidateWeights& w, std::uint32_t kept) {
  CandidateWeights restricted{};
  double sum = 0.0;
  for (int j = 0; j < size; ++j) {
    restricted[j] = (kept >> j & 1u) != 0 ? w[j] : 0.0;
    sum += restricted[j];
  }
  for (int j = 0; j < size; ++j) restricted[j] /= sum;
  return restricted;
}

std::uint32_t Heaviest(int size, const CandidateWeights& w, int count) {
  std::array<int, kMaxCandidates> order;
  for (int j = 0; j < size; ++j) order[j] = j;
  std::partial_sort(order.begin(), order.begin() + std::min(count, size), order.begin() + size,
                    [&](int a, int b) { return w[a] > w[b] || (w[a] == w[b] && a < b); });
  std::uint32_t kept = 0;
  for (int k = 0; k < std::min(count, size); ++k) kept |= 1u << order[k];
  return kept;
}

// Branch and bound over which candidates are left out.
class SupportSearch {
 public:
  SupportSearch(const SimplexQp& qp, int most) : qp_(qp), most_(most) {}

  void Offer(const CandidateWeights& w) {
    const double value = qp_.Value(w);
    if (found_ && value >= least_) return;
    found_ = true;
    least_ = value;
    best_ = w;
  }

  // `relaxed` is the least value's weights over `allowed`. Every sparse solution but those without
  // a candidate of `required` lies below.
  void Visit(std::uint32_t allowed, std::uint32_t required, const CandidateWeights& relaxed) {
    const std::uint32_t support = Support(qp_.size, relaxed);
    if (std::popcount(support) <= most_) return Offer(relaxed);
    if (found_ && qp_.Value(relaxed) >= least_) return;
    for (std::uint32_t left = support & ~required; left != 0;) {
      if (std::popcount(required) > most_) return;
      const int leave_out = Lightest(left, relaxed);
      const std::uint32_t bit = 1u << leave_out;
      CandidateWeights w = Restricted(qp_.size, relaxed, allowed & ~bit);
      MinimizeOnSimplex(qp_, allowed & ~bit, w);
      Visit(allowed & ~bit, required, w);
      left &= ~bit;
      required |= bit;
    }
  }

  const CandidateWeights& best() const { return best_; }

 private:
  static int Lightest(std::uint32_t among, const CandidateWeights& w) {
    int lightest = std::countr_zero(among);
    for (std::uint32_t left = among; left != 0; left &= left - 1) {
      const int j = std::countr_zero(left);
      if (w[j] < w[lightest]) lightest = j;
    }
    return lightest;
  }

  const SimplexQp& qp_;
  int most_;
  bool found_ = false;
  double least_ = 0.0;
  CandidateWeights best_{};
};

// Adds the pull towards `start`: the value there does not change.
SimplexQp WithProximal(const SimplexQp& qp, const CandidateWeights& start) {
  SimplexQp pulled = qp;
  const double pull = kProximal * LargestDiagonal(qp);
  for (int j = 0; j < qp.size; ++j) {
    pulled.gram[j][j] += pull;
    pulled.target[j] += pull * start[j];
  }
  return pulled;
}

}  // namespace

double SimplexQp::Value(const std::array<double, kMaxCandidates>& w) const {
  double value = 0.0;
  for (int i = 0; i < size; ++i) {
    double row = -2.0 * target[i];
    for (int j = 0; j < size; ++j) row += gram[i][j] * w[j];
    value += w[i] * row;
  }
  return value;
}

void MinimizeOnSimplex(const SimplexQp& qp, std::uint32_t allowed, CandidateWeights& w) {
  const double tolerance = kSlopeTolerance * LargestDiagonal(qp);
  const int most_exchanges = 10 * qp.size;  // each lowers the value: a guard against rounding only
  FreeSet free(qp);
  for (int j = 0; j < qp.size; ++j) {
    if (w[j] > 0.0) free.Add(j);
  }
  std::array<double, kMaxCandidates> solution;
  for (int exchange = 0; exchange < most_exchanges; ++exchange) {
    while (free.size() > 1 && free.Solve(solution) && !StepToSolution(free, solution, w)) {
    }
    if (free.size() == 1) w[free[0]] = 1.0;
    const int entering = SteepestCandidate(qp, allowed, free, w, tolerance);
    if (entering < 0) break;
    free.Add(entering);
  }
  CleanUp(qp.size, w);
}

void MinimizeSparseOnSimplex(const SimplexQp& qp, int most, CandidateWeights& w) {
  const SimplexQp pulled = WithProximal(qp, w);
  const std::uint32_t all = (1u << qp.size) - 1u;
  CandidateWeights relaxed = w;
  MinimizeOnSimplex(pulled, all, relaxed);
  SupportSearch search(pulled, most);
  if (std::popcount(Support(qp.size, w)) <= most) search.Offer(w);
  if (std::popcount(Support(qp.size, relaxed)) > most) {
    const std::uint32_t heaviest = Heaviest(qp.size, relaxed, most);
    CandidateWeights first = Restricted(qp.size, relaxed, heaviest);
    MinimizeOnSimplex(pulled, heaviest, first);
    search.Offer(first);
  }
  search.Visit(all, 0, relaxed);
  w = search.best();
}

}  // namespace vitruvia::skinning
