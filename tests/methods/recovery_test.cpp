// Knowing when the subject is lost, and finding it again.
#include "methods/realtime_scape/recovery.h"

#include <gtest/gtest.h>

#include "body/skinning.h"
#include "methods/realtime_scape/realtime_scape.h"
#include "support/arm_stage.h"

namespace vitruvia::realtime_scape {
namespace {

VertexClasses Classes(int near_surface, int elsewhere) {
  VertexClasses classes;
  classes.near_surface.resize(near_surface);
  classes.elsewhere.resize(elsewhere);
  return classes;
}

// A pose whose bones are turned against each other by `angle_rad`.
BodyPose Bent(double angle_rad) {
  BodyPose pose;
  for (int j = 0; j < kBoneCount; ++j) pose[j].rotation = ExpSo3<double>({angle_rad * j, 0.0, 0.0});
  return pose;
}

TEST(Agreement, IsTheShareExplainedTimesTheShareConfirmed) {
  EXPECT_DOUBLE_EQ(Agreement(200, 50, Classes(30, 10)), 0.75 * 0.75);
  EXPECT_DOUBLE_EQ(Agreement(200, 0, Classes(30, 0)), 1.0);
  EXPECT_DOUBLE_EQ(Agreement(0, 0, Classes(30, 0)), 0.0);
  EXPECT_DOUBLE_EQ(Agreement(200, 0, Classes(0, 0)), 0.0);
}

TEST(Recovery, TriesOnceAgreementHasBeenLowForLongAndThenAfterEachPause) {
  RecoverySettings settings;
  settings.patience = 3;
  settings.pause = 2;
  settings.below = 0.7;
  Recovery recovery(settings);
  EXPECT_FALSE(recovery.Note(0.9, Bent(0.0)));
  EXPECT_DOUBLE_EQ(recovery.usual_agreement(), 0.9);
  EXPECT_FALSE(recovery.Note(0.64, Bent(0.0)));  // not below 0.7 · 0.9
  EXPECT_FALSE(recovery.is_lost());
  std::vector<bool> tries;
  for (int i = 0; i < 6; ++i) tries.push_back(recovery.Note(0.5, Bent(0.0)));
  EXPECT_EQ(tries, (std::vector<bool>{false, false, true, false, true, false}));
  EXPECT_TRUE(recovery.is_lost());
  recovery.Found(0.95);
  EXPECT_FALSE(recovery.is_lost());
  EXPECT_DOUBLE_EQ(recovery.usual_agreement(), 0.95);
}

TEST(Recovery, DoubtsABadFirstFrameAtOnceAndGetsUsedToABadSensor) {
  Recovery recovery{RecoverySettings{}};
  EXPECT_TRUE(recovery.Note(0.5, Bent(0.0)));
  EXPECT_FALSE(recovery.Note(0.5, Bent(0.0)));
  EXPECT_FALSE(recovery.is_lost());
  Recovery never{RecoverySettings{.patience = 0}};
  EXPECT_FALSE(never.Note(0.5, Bent(0.0)));
}

TEST(Recovery, KeepsGoodPosesThatDifferAndTurnsThem) {
  RecoverySettings settings;
  settings.remembered = 3;
  settings.apart_deg = 20.0;
  Recovery recovery(settings);
  const auto hypotheses = [&] { return recovery.Hypotheses(Bent(0.0)).size(); };
  recovery.Note(0.9, Bent(0.0));
  EXPECT_EQ(hypotheses(), 2u * 16u);  // the first and the latest, 8 headings, upside down too
  recovery.Note(0.9, Bent(0.1));      // 6 degrees: nothing new
  EXPECT_EQ(hypotheses(), 2u * 16u);
  recovery.Note(0.9, Bent(0.6));
  recovery.Note(0.2, Bent(1.2));  // new, but it agrees badly
  EXPECT_EQ(hypotheses(), 3u * 16u);
  recovery.Note(0.9, Bent(1.2));
  recovery.Note(0.9, Bent(-0.8));  // takes an older one's place
  EXPECT_EQ(hypotheses(), 4u * 16u);
  const std::vector<BodyPose> turned = recovery.Hypotheses(Shifted(Bent(0.3), {0.1, 0.2, 3.0}));
  for (const BodyPose& pose : turned) {
    EXPECT_NEAR(
        (pose[0].rotation.transpose() * pose[0].rotation - Matrix3<double>::Identity()).norm(), 0.0,
        1e-12);
  }
  EXPECT_NEAR((turned[turned.size() - 16][0].center - Vector3d(0.1, 0.2, 3.0)).norm(), 0.0, 1e-12);
}

// Follows a body that vanishes and comes back elsewhere, turned by 100 degrees.
double ErrorAfterReturn(int patience) {
  const Rigidd before{Vector3d(1, -1, -1).asDiagonal(), {0.05, 0.9, 2.8}};
  const Rigidd after = Rigidd{Matrix3<double>::Identity(), {0.5, 0.0, 0.4}} * before *
                       Rigidd{ExpSo3<double>({0.0, 1.75, 0.0}), Vector3d::Zero()};
  ArmStage first(1, SkinLinear, before), second(1, SkinLinear, after);
  Settings settings;
  settings.recovery.patience = patience;
  RealtimeScape tracker(settings);
  tracker.Start(first.body, first.camera);
  for (int i = 0; i < 5; ++i) tracker.TrackFrame(first.Frame(i, 0.05 * i));
  double error_m = 0.0;
  for (int i = 0; i < 12; ++i)
    error_m = second.MeanError(tracker.TrackFrame(second.Frame(i, 0.2)), 0.2);
  return error_m;
}

TEST(Recovery, FindsABodyThatCameBackElsewhere) {
  EXPECT_LT(ErrorAfterReturn(3), 0.01);
  EXPECT_GT(ErrorAfterReturn(0), 0.1);
}

}  // namespace
}  // namespace vitruvia::realtime_scape
