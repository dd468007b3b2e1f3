#include "metrics/reconstruction_error.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/random.h"

namespace vitruvia {
namespace {

const TriangleMesh kSquare{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};

TEST(DistancesToSurface, AreThoseOfASquareInClosedForm) {
  const std::vector<Vector3f> points{
      {0.5f, 0.25f, 0.3f}, {0.5f, 0.25f, -0.3f}, {1.3f, 0.5f, 0.4f}, {-3.0f, -4.0f, 0.0f}};
  const std::vector<double> distances = DistancesToSurface(points, kSquare);
  EXPECT_NEAR(distances[0], 0.3, 1e-6);
  EXPECT_NEAR(distances[1], 0.3, 1e-6);
  EXPECT_NEAR(distances[2], 0.5, 1e-6);
  EXPECT_NEAR(distances[3], 5.0, 1e-6);
}

TEST(DistancesToSurface, DoNotSeeSlidingAlongTheSurface) {
  for (const float shift : {0.0f, 0.1f, 0.37f}) {
    const auto distances = DistancesToSurface({{0.2f + shift, 0.5f, 0.01f}}, kSquare);
    EXPECT_NEAR(distances[0], 0.01, 1e-7);
  }
}

TEST(DistancesToPoints, AreThoseOfBruteForce) {
  RandomStream random(5, "points");
  const auto cloud = [&](int count) {
    std::vector<Vector3f> points;
    for (int i = 0; i < count; ++i) {
      points.push_back(
          Vector3d(random.Uniform(), random.Uniform(), random.Uniform()).cast<float>());
    }
    return points;
  };
  const std::vector<Vector3f> points = cloud(50), observed = cloud(300);
  const std::vector<double> distances = DistancesToPoints(points, observed);
  for (std::size_t i = 0; i < points.size(); ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vector3f& o : observed) {
      nearest = std::min(nearest, (points[i] - o).cast<double>().norm());
    }
    EXPECT_NEAR(distances[i], nearest, 1e-6);
  }
}

TEST(ReconstructionError, IsInfiniteForWhatIsNoPlace) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Vector3f> points{{nan, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
  EXPECT_TRUE(std::isinf(DistancesToSurface(points, kSquare)[0]));
  EXPECT_NEAR(DistancesToSurface(points, kSquare)[1], 1.0, 1e-6);
  EXPECT_TRUE(std::isinf(DistancesToPoints(points, {{0, 0, 0}})[0]));
  EXPECT_TRUE(std::isinf(DistancesToPoints({{0, 0, 0}}, {})[0]));
}

}  // namespace
}  // namespace vitruvia
