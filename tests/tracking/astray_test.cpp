#include "tracking/astray.h"

#include <gmock/gmock.h>

namespace vitruvia {
namespace {

// A wall 2 m away that fills the image, and one vertex.
TrackResult ResultAt(const Vector3f& vertex, float depth_m = 2.0f) {
  const PinholeCamera camera{9, 7, 8.0, 8.0, 4.0, 3.0};
  TrackResult result;
  result.outcome = Outcome::kIterationLimit;
  result.vertices = {{0.0f, 0.0f, 2.0f}, vertex};
  MarkAstray({0, 0.0, DepthImage(camera.width, camera.height, depth_m)}, camera, 2.0, result);
  return result;
}

TEST(Astray, AVertexBeyondTenDiagonalsOfTheSubjectIsALostFrame) {
  EXPECT_EQ(ResultAt({0.0f, 0.0f, 21.9f}).outcome, Outcome::kIterationLimit);
  const TrackResult astray = ResultAt({0.0f, 0.0f, 82.0f});
  EXPECT_EQ(astray.outcome, Outcome::kLost);
  EXPECT_THAT(astray.message, testing::HasSubstr("80 m from the middle of the measured points"));
  EXPECT_EQ(ResultAt({-20.1f, 0.0f, 2.0f}).outcome, Outcome::kLost);
}

TEST(Astray, FramesWithoutMeasurementsSayNothing) {
  EXPECT_EQ(ResultAt({0.0f, 0.0f, 82.0f}, 0.0f).outcome, Outcome::kIterationLimit);
}

}  // namespace
}  // namespace vitruvia
