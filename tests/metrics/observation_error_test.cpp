// A plate before a wall, held against a plate elsewhere: every number follows from the picture.
#include "metrics/observation_error.h"

#include <cmath>

#include <gtest/gtest.h>

#include "math/statistics.h"

namespace vitruvia {
namespace {

const PinholeCamera kCamera{80, 60, 80.0, 80.0, 39.5, 29.5};
constexpr double kVisibleWithin_m = 0.01;

// An upright plate of a fine grid, camera frame, facing the camera.
TriangleMesh Plate(double left, double right, double depth) {
  constexpr int kCells = 20;
  TriangleMesh mesh;
  for (int j = 0; j <= kCells; ++j) {
    for (int i = 0; i <= kCells; ++i)
      mesh.vertices.emplace_back(static_cast<float>(left + (right - left) * i / kCells),
                                 static_cast<float>(-0.4 + 0.8 * j / kCells),
                                 static_cast<float>(depth));
  }
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0; i < kCells; ++i) {
      const int a = j * (kCells + 1) + i, b = a + kCells + 1;
      mesh.triangles.push_back({a, b, a + 1});
      mesh.triangles.push_back({a + 1, b, b + 1});
    }
  }
  return mesh;
}

DepthImage Seen(const TriangleMesh& mesh) {
  ZBuffer zbuffer(kCamera);
  return zbuffer.Render(mesh.vertices, mesh.triangles);
}

DepthImage BeforeWall(DepthImage depth, float wall_m) {
  for (float& z : depth.pixels()) {
    if (z == 0.0f) z = wall_m;
  }
  return depth;
}

ObservationError Compare(const TriangleMesh& estimate, const DepthImage& person) {
  ZBuffer zbuffer(kCamera);
  return CompareWithObservation(estimate, person, BeforeWall(person, 3.0f), kCamera,
                                kVisibleWithin_m, 1000, zbuffer);
}

TEST(ObservationError, TruthExplainsEverything) {
  const TriangleMesh plate = Plate(-0.4, 0.4, 2.0);
  const ObservationError error = Compare(plate, Seen(plate));
  EXPECT_LT(Maximum(error.points_to_model_m), 1e-5);
  EXPECT_LT(Maximum(error.model_to_points_m), 0.02);  // half a pixel at 2 m, on the diagonal
  EXPECT_DOUBLE_EQ(error.silhouette_overlap, 1.0);
  EXPECT_DOUBLE_EQ(error.points_unexplained, 0.0);
  EXPECT_DOUBLE_EQ(error.model_in_front, 0.0);
}

TEST(ObservationError, PlateTooNearIsOffByThatDistanceAndStandsInFront) {
  const ObservationError little = Compare(Plate(-0.4, 0.4, 1.97), Seen(Plate(-0.4, 0.4, 2.0)));
  for (const double d : little.points_to_model_m) EXPECT_NEAR(d, 0.03, 1e-5);
  EXPECT_DOUBLE_EQ(little.points_unexplained, 0.0);
  const ObservationError much = Compare(Plate(-0.4, 0.4, 1.9), Seen(Plate(-0.4, 0.4, 2.0)));
  for (const double d : much.points_to_model_m) EXPECT_NEAR(d, 0.1, 1e-5);
  EXPECT_DOUBLE_EQ(much.points_unexplained, 1.0);
  EXPECT_DOUBLE_EQ(much.model_in_front, 1.0);
}

TEST(ObservationError, PlateAsideIsHalfExplained) {
  // Half of the estimate lies beside the plate, before the wall.
  const ObservationError error = Compare(Plate(0.0, 0.8, 2.0), Seen(Plate(-0.4, 0.4, 2.0)));
  EXPECT_NEAR(error.silhouette_overlap, 1.0 / 3.0, 0.02);
  EXPECT_NEAR(error.model_in_front, 0.5, 0.02);
  // Of the left half all but the last 5 cm.
  EXPECT_NEAR(error.points_unexplained, 0.35 / 0.8, 0.03);
}

TEST(ObservationError, NothingMeasuredIsAbsentAndNotZero) {
  const ObservationError error = Compare(Plate(-0.4, 0.4, 2.0), DepthImage(80, 60));
  EXPECT_TRUE(error.points_to_model_m.empty());
  EXPECT_TRUE(error.model_to_points_m.empty());
  EXPECT_TRUE(std::isnan(error.silhouette_overlap));
  EXPECT_TRUE(std::isnan(error.model_in_front));
}

TEST(PointsUnseen, AreBehindTheDepthOrOutsideTheImage) {
  const DepthImage depth(80, 60, 2.0f);
  const std::vector<Vector3f> points{
      {0, 0, 2.0f}, {0, 0, 1.5f}, {0, 0, 2.2f}, {5, 0, 2.0f}, {0, 0, -1.0f}};
  const std::vector<Vector3f> unseen = PointsUnseen(points, depth, kCamera, 0.05);
  ASSERT_EQ(unseen.size(), 3u);
  EXPECT_EQ(unseen[0], points[2]);
  EXPECT_EQ(unseen[1], points[3]);
  EXPECT_EQ(unseen[2], points[4]);
}

}  // namespace
}  // namespace vitruvia
