#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "math/statistics.h"
#include "metrics/joint_error.h"
#include "metrics/vertex_error.h"

namespace vitruvia {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(Quantile, InterpolatesBetweenOrderStatistics) {
  const std::vector<double> values = {4.0, 1.0, 3.0, 2.0};
  EXPECT_EQ(Quantile(values, 0.0), 1.0);
  EXPECT_EQ(Quantile(values, 1.0), 4.0);
  EXPECT_EQ(Quantile(values, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(Quantile(values, 0.95), 3.85);  // numpy.quantile
  EXPECT_EQ(Quantile({7.0}, 0.3), 7.0);
  EXPECT_THROW(Quantile({}, 0.5), std::invalid_argument);
  EXPECT_THROW(Quantile(values, 1.1), std::invalid_argument);
}

TriangleMesh Tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

TEST(RestCorrespondence, OfAMeshWithItselfIsExact) {
  const TriangleMesh mesh = Tetrahedron();
  const std::vector<Vector3f> posed = {
      {0.1f, 0.7f, 3}, {1.3f, 0, 2}, {0, 1.7f, 4}, {0.3f, 0.3f, 1.1f}};
  EXPECT_EQ(RestCorrespondence(mesh, mesh).TruePositions(posed), posed);
}

TEST(RestCorrespondence, CarriesAPointOfAFaceAlong) {
  const TriangleMesh mesh = Tetrahedron();
  TriangleMesh estimate;
  estimate.vertices = {{0.25f, 0.25f, -0.1f}};  // nearest to the face z = 0
  std::vector<Vector3f> posed = mesh.vertices;
  for (Vector3f& v : posed) v = 2.0f * v + Vector3f(1, 1, 1);
  const auto truth = RestCorrespondence(estimate, mesh).TruePositions(posed);
  EXPECT_TRUE(truth[0].isApprox(Vector3f(1.5f, 1.5f, 1.0f), 1e-6f));
}

TEST(VertexErrors, AreDistancesAndInfiniteWhereNotFinite) {
  const auto errors =
      VertexErrors({{0, 0, 0}, {3, 4, 0}, {kNan, 0, 0}}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  EXPECT_EQ(errors[0], 0.0);
  EXPECT_EQ(errors[1], 5.0);
  EXPECT_EQ(errors[2], std::numeric_limits<double>::infinity());
  EXPECT_THROW(VertexErrors({{0, 0, 0}}, {}), std::invalid_argument);
}

TEST(Summarize, SplitsByVisibility) {
  const VertexErrorSummary summary = Summarize({1.0, 2.0, 6.0}, {true, true, false});
  EXPECT_EQ(summary.mean_m, 3.0);
  EXPECT_EQ(summary.max_m, 6.0);
  EXPECT_EQ(summary.visible_mean_m, 1.5);
  EXPECT_EQ(summary.visible_max_m, 2.0);
  EXPECT_EQ(summary.hidden_mean_m, 6.0);
  EXPECT_EQ(summary.hidden_max_m, 6.0);
}

TEST(Summarize, ErrorOverNoVerticesIsNotANumber) {
  const VertexErrorSummary all_hidden = Summarize({1.0, 3.0}, {false, false});
  EXPECT_EQ(all_hidden.mean_m, 2.0);
  EXPECT_EQ(all_hidden.hidden_max_m, 3.0);
  EXPECT_TRUE(std::isnan(all_hidden.visible_mean_m));
  EXPECT_TRUE(std::isnan(all_hidden.visible_max_m));
  const VertexErrorSummary all_visible = Summarize({1.0, 3.0}, {true, true});
  EXPECT_TRUE(std::isnan(all_visible.hidden_mean_m));
  EXPECT_TRUE(std::isnan(all_visible.hidden_max_m));
}

TEST(VisiblePoints, AreThoseInTheImageAndNotBehindTheSurface) {
  const PinholeCamera camera;
  DepthImage depth(camera.width, camera.height, 2.0f);
  const auto visible = VisiblePoints(
      {{0, 0, 2.005f}, {0, 0, 2.1f}, {9, 0, 2}, {0, 0, -1}, {0, 0, kNan}}, depth, camera, 0.01);
  EXPECT_EQ(visible, (std::vector<bool>{true, false, false, false, false}));
}

TEST(JointAccuracy, OfTheTruthIsPerfectAtEveryThreshold) {
  const std::vector<Vector3<double>> truth = {{0.1, 0.2, 3.0}, {1.0, -0.5, 2.5}};
  const auto errors = JointErrors(truth, truth);
  const auto thresholds = Thresholds(0.005, 0.3);
  ASSERT_EQ(thresholds.size(), 61u);
  EXPECT_EQ(thresholds.front(), 0.0);
  EXPECT_DOUBLE_EQ(thresholds.back(), 0.3);
  for (const double share : AccuracyCurve(errors, thresholds)) EXPECT_EQ(share, 1.0);
}

TEST(JointAccuracy, CountsWithinTheThresholdInclusive) {
  EXPECT_EQ(ShareWithin({0.05, 0.1, 0.2, std::numeric_limits<double>::infinity()}, 0.1), 0.5);
  EXPECT_EQ(ShareWithin({}, 0.1), 0.0);
}

}  // namespace
}  // namespace vitruvia
