#include "learning/skinning/simplex_qp.h"

#include <bit>
#include <limits>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "core/random.h"

namespace vitruvia::skinning {
namespace {

// Least squares of `rows` equations: G = AᵀA, c = Aᵀb.
SimplexQp RandomQp(int size, int rows, RandomStream& random) {
  Eigen::MatrixXd a(rows, size);
  Eigen::VectorXd b(rows);
  for (double& x : a.reshaped()) x = random.Normal();
  for (double& x : b) x = random.Normal();
  SimplexQp qp;
  qp.size = size;
  const Eigen::MatrixXd gram = a.transpose() * a;
  const Eigen::VectorXd target = a.transpose() * b;
  for (int i = 0; i < size; ++i) {
    qp.target[i] = target[i];
    for (int j = 0; j < size; ++j) qp.gram[i][j] = gram(i, j);
  }
  return qp;
}

// The best of all supports of at most `most` candidates, each solved on its sum-one hyperplane by a
// Lagrange multiplier and kept if no weight is negative.
double BruteForceValue(const SimplexQp& qp, int most) {
  double best = std::numeric_limits<double>::infinity();
  for (std::uint32_t support = 1; support < 1u << qp.size; ++support) {
    const int n = std::popcount(support);
    if (n > most) continue;
    std::vector<int> members;
    for (int j = 0; j < qp.size; ++j) {
      if (support >> j & 1u) members.push_back(j);
    }
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 1, n + 1);
    Eigen::VectorXd right = Eigen::VectorXd::Ones(n + 1);
    for (int i = 0; i < n; ++i) {
      right[i] = qp.target[members[i]];
      system(i, n) = system(n, i) = 1.0;
      for (int j = 0; j < n; ++j) system(i, j) = qp.gram[members[i]][members[j]];
    }
    const Eigen::VectorXd x = system.fullPivLu().solve(right);
    if (x.head(n).minCoeff() < 0.0) continue;
    CandidateWeights w{};
    for (int i = 0; i < n; ++i) w[members[i]] = x[i];
    best = std::min(best, qp.Value(w));
  }
  return best;
}

void ExpectOnSimplex(const SimplexQp& qp, const CandidateWeights& w, int most) {
  double sum = 0.0;
  int support = 0;
  for (int j = 0; j < qp.size; ++j) {
    EXPECT_GE(w[j], 0.0);
    sum += w[j];
    support += w[j] > 0.0;
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_LE(support, most);
}

TEST(SimplexQp, FindsTheBestOfAllSupports) {
  RandomStream random(1, "qp");
  for (int problem = 0; problem < 300; ++problem) {
    const int size = 1 + static_cast<int>(random.Index(8));
    const int rows = size + static_cast<int>(random.Index(20));
    const SimplexQp qp = RandomQp(size, rows, random);
    for (int most = 1; most <= 4; ++most) {
      CandidateWeights w{};
      w[random.Index(size)] = 1.0;
      MinimizeSparseOnSimplex(qp, most, w);
      ExpectOnSimplex(qp, w, most);
      EXPECT_NEAR(qp.Value(w), BruteForceValue(qp, most), 1e-7) << problem << " " << most;
    }
  }
}

TEST(SimplexQp, FindsTheBestWithoutALimit) {
  RandomStream random(2, "qp");
  for (int problem = 0; problem < 300; ++problem) {
    const int size = 2 + static_cast<int>(random.Index(7));
    const SimplexQp qp = RandomQp(size, size + 5, random);
    CandidateWeights w{};
    w[0] = 1.0;
    MinimizeOnSimplex(qp, (1u << size) - 1u, w);
    ExpectOnSimplex(qp, w, size);
    EXPECT_NEAR(qp.Value(w), BruteForceValue(qp, size), 1e-9) << problem;
  }
}

TEST(SimplexQp, UsesAllowedCandidatesOnly) {
  RandomStream random(3, "qp");
  for (int problem = 0; problem < 50; ++problem) {
    const SimplexQp qp = RandomQp(6, 20, random);
    CandidateWeights w{};
    w[1] = 1.0;
    MinimizeOnSimplex(qp, 0b010110u, w);
    EXPECT_EQ(w[0] + w[3] + w[5], 0.0);
  }
}

TEST(SimplexQp, NeverEndsWorseThanItStarted) {
  RandomStream random(4, "qp");
  for (int problem = 0; problem < 300; ++problem) {
    const int size = 4 + static_cast<int>(random.Index(6));
    // Fewer equations than candidates: many minima.
    const SimplexQp qp = RandomQp(size, 1 + static_cast<int>(random.Index(3)), random);
    CandidateWeights w{};
    for (int k = 0; k < 4; ++k) w[random.Index(size)] += 0.25;
    const double before = qp.Value(w);
    MinimizeSparseOnSimplex(qp, 4, w);
    ExpectOnSimplex(qp, w, 4);
    EXPECT_LE(qp.Value(w), before + 1e-12);
  }
}

TEST(SimplexQp, LeavesBonesThatMoveAlikeWhereTheyAre) {
  // Candidates 0 and 1 are the same; the best is 0.6 of them and 0.4 of candidate 2.
  SimplexQp qp;
  qp.size = 3;
  const double places[3] = {0.0, 0.0, 1.0};
  for (int i = 0; i < 3; ++i) {
    qp.target[i] = 0.4 * places[i];
    for (int j = 0; j < 3; ++j) qp.gram[i][j] = places[i] * places[j];
  }
  CandidateWeights w{0.4, 0.6, 0.0};
  MinimizeSparseOnSimplex(qp, 4, w);
  EXPECT_NEAR(w[2], 0.4, 1e-6);
  EXPECT_NEAR(w[1] - w[0], 0.2, 1e-4);
}

}  // namespace
}  // namespace vitruvia::skinning
