#include "methods/gmm_articulated/mixture.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/random.h"

namespace vitruvia::gmm_articulated {
namespace {

std::vector<Vector3f> Cloud(int count, double range, const char* stream) {
  RandomStream random(1, stream);
  std::vector<Vector3f> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(Vector3d(random.Uniform(-range, range), random.Uniform(-range, range),
                              2.5 + random.Uniform(-range, range))
                         .cast<float>());
  }
  return points;
}

TEST(PointGrid, RunsHoldAllThatIsNear) {
  constexpr float kCell_m = 0.07f;
  const std::vector<Vector3f> points = Cloud(500, 0.4, "points");
  PointGrid grid;
  grid.Build(points, kCell_m);
  for (const Vector3f& place : Cloud(100, 0.6, "places")) {
    std::vector<int> seen(points.size(), 0);
    grid.ForRunsNear(place, [&](int begin, int end) {
      for (int at = begin; at < end; ++at) {
        ++seen[grid.indices()[at]];
        EXPECT_EQ(Vector3f(grid.x()[at], grid.y()[at], grid.z()[at]), points[grid.indices()[at]]);
      }
    });
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_LE(seen[i], 1);
      if ((points[i] - place).norm() < kCell_m) {
        EXPECT_EQ(seen[i], 1);
      }
    }
  }
}

TEST(Mixture, IsWhatEveryPairSays) {
  constexpr double kSigma = 0.05;
  const MixtureSettings settings{0.1, 2.0, 3.0};
  const std::vector<Vector3f> data = Cloud(120, 0.2, "data"), vertices = Cloud(60, 0.2, "vertices");
  WorkerTeam team(1);
  Mixture mixture;
  mixture.Expect(data, vertices, kSigma, settings, team);
  const double c =
      std::pow(2.0 * std::numbers::pi * kSigma * kSigma, 1.5) * 0.1 * 60.0 / (0.9 * 2.0);
  std::vector<double> mass(vertices.size(), 0.0), squares = mass;
  std::vector<Vector3d> moment(vertices.size(), Vector3d::Zero());
  const std::vector<float> explained = mixture.Explained();
  for (std::size_t n = 0; n < data.size(); ++n) {
    std::vector<double> e;
    double sum = 0.0;
    for (const Vector3f& v : vertices) {
      const double d2 = (data[n] - v).cast<double>().squaredNorm();
      e.push_back(d2 < 9.0 * kSigma * kSigma ? std::exp(-0.5 * d2 / (kSigma * kSigma)) : 0.0);
      sum += e.back();
    }
    EXPECT_NEAR(explained[n], sum / (sum + c), 1e-4);
    EXPECT_LE(explained[n], 1.0f);
    for (std::size_t m = 0; m < vertices.size(); ++m) {
      const double p = e[m] / (sum + c);
      const Vector3d away = (data[n] - vertices[m]).cast<double>();
      mass[m] += p;
      moment[m] += p * away;
      squares[m] += p * away.squaredNorm();
    }
  }
  double total = 0.0, all_squares = 0.0;
  for (std::size_t m = 0; m < vertices.size(); ++m) {
    const VertexShare& share = mixture.shares()[m];
    EXPECT_NEAR(share.mass, mass[m], 1e-3);
    if (mass[m] > 0.1) {
      EXPECT_LT((share.offset.cast<double>() - moment[m] / mass[m]).norm(), 1e-4);
    }
    total += mass[m];
    all_squares += squares[m];
  }
  EXPECT_NEAR(mixture.mass(), total, 1e-3);
  EXPECT_NEAR(mixture.Variance(std::vector<Vector3f>(vertices.size(), Vector3f::Zero())),
              all_squares / (3.0 * total), 1e-6);
}

// Without outliers, and each datum in reach of its own vertex alone: closest points.
TEST(Mixture, OneToOneDataGiveTheirOwnOffsets) {
  std::vector<Vector3f> vertices, data;
  for (int i = 0; i < 20; ++i) {
    vertices.push_back({0.2f * static_cast<float>(i), 0.0f, 2.0f});
    data.push_back(vertices.back() + Vector3f(0.01f, -0.02f, 0.005f));
  }
  WorkerTeam team(1);
  Mixture mixture;
  mixture.Expect(data, vertices, 0.03, {0.0, 1.0, 3.0}, team);
  for (const VertexShare& share : mixture.shares()) {
    EXPECT_NEAR(share.mass, 1.0f, 1e-6);
    EXPECT_LT((share.offset - Vector3f(0.01f, -0.02f, 0.005f)).norm(), 1e-6);
    EXPECT_NEAR(share.spread_m2, 0.0f, 1e-9);
  }
}

// Expectation and maximisation in turn, where each vertex moves freely: σ² falls in every round.
TEST(Mixture, VarianceFallsInEveryRound) {
  const std::vector<Vector3f> data = Cloud(400, 0.15, "data");
  std::vector<Vector3f> vertices = Cloud(80, 0.15, "vertices");
  WorkerTeam team(1);
  Mixture mixture;
  double variance = 0.05 * 0.05;
  for (int round = 0; round < 8; ++round) {
    mixture.Expect(data, vertices, std::sqrt(variance), {0.02, 1.0, 10.0}, team);
    std::vector<Vector3f> moves;
    for (std::size_t m = 0; m < vertices.size(); ++m) {
      moves.push_back(mixture.shares()[m].offset);
      vertices[m] += moves.back();
    }
    const double next = mixture.Variance(moves);
    EXPECT_LT(next, variance * (1.0 + 1e-5)) << round;
    variance = next;
  }
  EXPECT_LT(variance, 0.04 * 0.04);
}

}  // namespace
}  // namespace vitruvia::gmm_articulated
