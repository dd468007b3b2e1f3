#include "search/nearest_neighbors.h"

#include <limits>

#include <gtest/gtest.h>

#include "core/random.h"

namespace vitruvia {
namespace {

const PinholeCamera kCamera;
constexpr Association kAll[] = {Association::kKdTree, Association::kWindow,
                                Association::kExhaustive};

std::vector<Vector3f> RandomPoints(std::string_view stream, int count) {
  RandomStream random(4, stream);
  std::vector<Vector3f> points(count);
  for (Vector3f& p : points) {
    p = {static_cast<float>(random.Uniform(-0.8, 0.8)),
         static_cast<float>(random.Uniform(-0.6, 0.6)),
         static_cast<float>(random.Uniform(2.0, 2.6))};
  }
  return points;
}

int BruteForce(const Vector3f& query, const std::vector<Vector3f>& points, float max_distance) {
  int best = -1;
  float best_squared = max_distance * max_distance;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float squared = (points[i] - query).squaredNorm();
    if (squared < best_squared) {
      best = static_cast<int>(i);
      best_squared = squared;
    }
  }
  return best;
}

TEST(NearestNeighbors, AllFindWhatBruteForceFinds) {
  // 203 points: no whole number of groups of eight. A window of 400 px holds every reach.
  const std::vector<Vector3f> points = RandomPoints("points", 203);
  const std::vector<Vector3f> queries = RandomPoints("queries", 100);
  for (const Association association : kAll) {
    const auto neighbors = MakeNearestNeighbors(association, kCamera, 400);
    neighbors->Build(points);
    for (const float reach : {0.02f, 0.1f, 0.5f}) {
      std::vector<KdTree::Neighbor> found;
      neighbors->FindNearest(queries, reach, found);
      ASSERT_EQ(found.size(), queries.size());
      for (std::size_t q = 0; q < queries.size(); ++q) {
        const int expected = BruteForce(queries[q], points, reach);
        EXPECT_EQ(found[q].index, expected) << static_cast<int>(association) << " " << reach;
        if (expected >= 0) {
          EXPECT_NEAR(found[q].squared_distance, (points[expected] - queries[q]).squaredNorm(),
                      1e-6);
        }
      }
    }
  }
}

TEST(NearestNeighbors, AWindowLooksNoFartherThanItsHalfWidth) {
  const auto window = MakeNearestNeighbors(Association::kWindow, kCamera, 8);
  window->Build({kCamera.Unproject(100.0f, 100.0f, 2.0f)});
  std::vector<KdTree::Neighbor> found;
  window->FindNearest({kCamera.Unproject(105.0f, 100.0f, 2.0f),
                       kCamera.Unproject(130.0f, 100.0f, 2.0f), Vector3f(0.0f, 0.0f, -1.0f)},
                      10.0f, found);
  EXPECT_EQ(found[0].index, 0);
  EXPECT_EQ(found[1].index, -1);
  EXPECT_EQ(found[2].index, -1) << "behind the camera";
}

TEST(NearestNeighbors, FindNothingInNothing) {
  for (const Association association : kAll) {
    const auto neighbors = MakeNearestNeighbors(association, kCamera, 50);
    neighbors->Build({});
    std::vector<KdTree::Neighbor> found;
    neighbors->FindNearest({Vector3f(0.0f, 0.0f, 2.0f)}, 10.0f, found);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].index, -1);
    neighbors->FindNearest({}, 10.0f, found);
    EXPECT_TRUE(found.empty());
  }
}

}  // namespace
}  // namespace vitruvia
