// Areas that a posed body and a frame do not account for, and what is told by them.
#include "tracking/body_areas.h"

#include <cmath>

#include <gtest/gtest.h>

#include "geometry/zbuffer.h"
#include "math/rigid.h"
#include "support/tiny_body.h"
#include "tracking/area_watch.h"

namespace vitruvia {
namespace {

constexpr double kReach_m = 0.3;
constexpr NearnessSettings kNearness{0.05f, 1, 0.02f};

// A body in the T-pose before the camera, and its own depth as the frame.
struct Stage {
  Stage() {
    for (const Vector3f& vertex : body.rest.vertices)
      vertices.push_back(camera_from_subject.Cast<float>() * vertex);
    ZBuffer zbuffer(camera);
    depth = zbuffer.Render(vertices, body.rest.triangles);
  }

  BodyAreas Measure(const DepthImage& frame, const std::vector<Vector3f>& surface) {
    return meter.Measure(surface, bones, frame, kNearness);
  }
  // Area across the line of sight of what a frame measures left of a column.
  double AreaLeftOf_m2(const DepthImage& frame, int column) const {
    double sum_m2 = 0.0;
    for (int v = 0; v < frame.height(); ++v) {
      for (int u = 0; u < column; ++u)
        sum_m2 += double{frame(u, v)} * frame(u, v) / (camera.fx * camera.fy);
    }
    return sum_m2;
  }

  const PinholeCamera camera{640, 480, 560.0, 560.0, 319.5, 239.5};
  const Rigidd camera_from_subject{Vector3d(1, -1, -1).asDiagonal(), {0.0, 0.9, 2.5}};
  const BodyModel body = TinyBody(10);
  const BoneTransforms bones = BoneTransforms(kBoneCount, camera_from_subject);
  std::vector<Vector3f> vertices;
  DepthImage depth;
  BodyAreaMeter meter{body, camera, 1, 8.0, kReach_m};
};

TEST(BodyAreas, ABodyAccountsForItsOwnPicture) {
  Stage stage;
  const BodyAreas areas = stage.Measure(stage.depth, stage.vertices);
  EXPECT_DOUBLE_EQ(areas.disagreement(), 0.0);
  EXPECT_DOUBLE_EQ(areas.overlap(), 1.0);
  const double whole_m2 = stage.AreaLeftOf_m2(stage.depth, stage.camera.width);
  EXPECT_NEAR(areas.observed_m2, whole_m2, 1e-9);
  EXPECT_NEAR(areas.total().visible_m2(), whole_m2, 0.05 * whole_m2);
}

TEST(BodyAreas, AnArmThatTheFrameLacksIsContradictedAndOneThatTheModelLacksUnexplained) {
  Stage stage;
  constexpr int kColumn = 240;  // through the right upper arm; the subject's right is to the left
  const double arm_m2 = stage.AreaLeftOf_m2(stage.depth, kColumn);
  DepthImage without_arm = stage.depth;
  for (int v = 0; v < without_arm.height(); ++v) {
    for (int u = 0; u < kColumn; ++u) without_arm(u, v) = 0.0f;
  }
  const BodyAreas lacking = stage.Measure(without_arm, stage.vertices);
  EXPECT_NEAR(lacking.total().contradicted_m2, arm_m2, 0.15 * arm_m2);
  EXPECT_DOUBLE_EQ(lacking.total().unexplained_m2, 0.0);
  for (const BoneId id : {BoneId::kRightForearm, BoneId::kRightHand})
    EXPECT_DOUBLE_EQ(lacking.bones[static_cast<int>(id)].confirmed_m2, 0.0);
  EXPECT_DOUBLE_EQ(lacking.bones[static_cast<int>(BoneId::kLeftHand)].contradicted_m2, 0.0);

  std::vector<Vector3f> armless = stage.vertices;
  for (Vector3f& vertex : armless) {  // the right arm is folded into the trunk
    if (stage.camera.Project(vertex).x() < kColumn) vertex = Vector3f(0.0f, -0.4f, 2.55f);
  }
  const BodyAreas folded = stage.Measure(stage.depth, armless);
  EXPECT_NEAR(folded.total().unexplained_m2, arm_m2, 0.15 * arm_m2);
}

TEST(BodyAreas, WhatIsOutOfReachIsStrayAndNothingElse) {
  Stage stage;
  DepthImage with_wall = stage.depth;
  double wall_m2 = 0.0;
  for (int v = 0; v < 80; ++v) {
    with_wall(5, v) = 4.0f;
    wall_m2 += 16.0 / (stage.camera.fx * stage.camera.fy);
  }
  const BodyAreas areas = stage.Measure(with_wall, stage.vertices);
  EXPECT_NEAR(areas.stray_m2, wall_m2, 1e-9);
  EXPECT_DOUBLE_EQ(areas.disagreement(), 0.0);
  const DepthImage stray = stage.meter.StrayDepth(with_wall);
  for (int v = 0; v < stray.height(); ++v) {
    for (int u = 0; u < stray.width(); ++u)
      ASSERT_EQ(stray(u, v), u == 5 && v < 80 ? 4.0f : 0.0f) << u << ", " << v;
  }
}

BodyAreas Disagreeing(double share) {
  BodyAreas areas;
  areas.observed_m2 = 1.0;
  areas.bones[0].confirmed_m2 = 1.0 - share;
  areas.bones[0].unexplained_m2 = share;
  return areas;
}

TEST(AreaWatch, IsLostAboveOneShareUntilItHasBeenBelowAnotherForSomeFrames) {
  AreaWatchSettings settings;
  settings.lost_above = 0.1;
  settings.found_below = 0.05;
  settings.found_frames = 2;
  AreaWatch watch(settings);
  std::vector<bool> lost;
  for (const double share : {0.09, 0.11, 0.06, 0.04, 0.06, 0.04, 0.04, 0.09}) {
    watch.Assess(Disagreeing(share));
    lost.push_back(watch.is_lost());
  }
  EXPECT_EQ(lost, (std::vector<bool>{false, true, true, true, true, true, false, false}));
}

TEST(AreaWatch, SearchesAnotherBodyAfterPausesThatGrow) {
  AreaWatchSettings settings;
  settings.lost_above = 0.1;
  settings.other_body_share = 0.5;
  settings.search_pause = 2;
  const auto searches = [&](double disagreement) {
    AreaWatch watch(settings);
    BodyAreas areas = Disagreeing(disagreement);
    areas.stray_m2 = 0.6;
    areas.observed_m2 += areas.stray_m2;
    std::vector<int> frames;
    for (int frame = 0; frame < 16; ++frame) {
      watch.Assess(areas);
      if (watch.is_search_due()) frames.push_back(frame);
    }
    return frames;
  };
  EXPECT_EQ(searches(0.2), (std::vector<int>{0, 2, 6, 14}));
  // What is out of reach is no sign of a lost limb: a subject that is tracked is not exchanged.
  EXPECT_EQ(searches(0.0), std::vector<int>{});
}

}  // namespace
}  // namespace vitruvia
