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

TEST(Agreement, CountsWhatIsExplainedConfirmedAndJudged) {
  const Agreement some = MeasureAgreement(200, 50, 80, Classes(30, 10));
  EXPECT_DOUBLE_EQ(some.explained, 0.75);
  EXPECT_DOUBLE_EQ(some.confirmed, 0.75);
  EXPECT_DOUBLE_EQ(some.judged, 0.5);
  EXPECT_DOUBLE_EQ(some.score(), 0.75 * 0.75);
  EXPECT_DOUBLE_EQ(MeasureAgreement(0, 0, 40, Classes(30, 0)).score(), 0.0);
  EXPECT_DOUBLE_EQ(MeasureAgreement(200, 0, 40, Classes(0, 0)).score(), 0.0);
}

TEST(Agreement, IsNotTroubledByWhatStandsBeforeTheBodyUnlessItHidesNearlyAll) {
  EXPECT_DOUBLE_EQ(MeasureAgreement(200, 150, 100, Classes(18, 2)).presence(), 0.9);
  EXPECT_DOUBLE_EQ(MeasureAgreement(200, 150, 1000, Classes(18, 2)).presence(), 0.25);
}

TEST(Recovery, TriesOnceAgreementHasBeenLowForLongAndThenAfterEachPause) {
  RecoverySettings settings;
  settings.patience = 3;
  settings.pause = 2;
  settings.below = 0.7;
  Recovery recovery(settings);
  EXPECT_FALSE(recovery.Note({1.0, 0.9, 1.0}, Bent(0.0)));
  EXPECT_DOUBLE_EQ(recovery.usual().presence(), 0.9);
  EXPECT_FALSE(recovery.Note({1.0, 0.64, 1.0}, Bent(0.0)));  // not below 0.7 · 0.9
  EXPECT_FALSE(recovery.is_lost());
  std::vector<bool> tries;
  for (int i = 0; i < 6; ++i) tries.push_back(recovery.Note({1.0, 0.5, 1.0}, Bent(0.0)));
  EXPECT_EQ(tries, (std::vector<bool>{false, false, true, false, true, false}));
  EXPECT_TRUE(recovery.is_lost());
  recovery.Found({1.0, 0.95, 1.0});
  EXPECT_FALSE(recovery.is_lost());
  EXPECT_DOUBLE_EQ(recovery.usual().presence(), 0.95);
}

TEST(Recovery, TriesAtOnceAfterAGap) {
  Recovery recovery{RecoverySettings{.patience = 3}};
  recovery.Note({1.0, 1.0, 1.0}, Bent(0.0));
  for (int i = 0; i < 3; ++i) recovery.NoteEmptyFrame();
  EXPECT_TRUE(recovery.is_lost());
  EXPECT_TRUE(recovery.Note({0.7, 0.7, 1.0}, Bent(0.0)));
}

TEST(Recovery, DoubtsABadFirstFrameAtOnceAndGetsUsedToABadSensor) {
  Recovery recovery{RecoverySettings{}};
  EXPECT_TRUE(recovery.Note({1.0, 0.5, 1.0}, Bent(0.0)));
  EXPECT_FALSE(recovery.Note({1.0, 0.5, 1.0}, Bent(0.0)));
  EXPECT_FALSE(recovery.is_lost());
  Recovery never{RecoverySettings{.patience = 0}};
  EXPECT_FALSE(never.Note({1.0, 0.5, 1.0}, Bent(0.0)));
}

TEST(Recovery, IsNotMisledByWhatStandsBeforeTheBody) {
  Recovery recovery{RecoverySettings{}};
  recovery.Note({1.0, 1.0, 1.0}, Bent(0.0));
  recovery.Note({0.2, 0.99, 0.9}, Bent(0.0));  // a post: unexplained, but the model fits
  EXPECT_FALSE(recovery.is_lost());
  recovery.Note({0.7, 0.93, 0.9}, Bent(0.0));  // the same amiss on both sides
  EXPECT_TRUE(recovery.is_lost());
  EXPECT_TRUE(recovery.IsBetter({0.9, 0.95, 0.9}, {0.7, 0.93, 0.9}));
  EXPECT_FALSE(recovery.IsBetter({0.9, 0.6, 0.9}, {0.2, 0.93, 0.9}));  // on the post
}

TEST(Recovery, KeepsGoodPosesThatDifferAndTurnsThem) {
  RecoverySettings settings;
  settings.remembered = 3;
  settings.apart_deg = 20.0;
  Recovery recovery(settings);
  const auto hypotheses = [&] { return recovery.Hypotheses(Bent(0.0)).size(); };
  recovery.Note({1.0, 0.9, 1.0}, Bent(0.0));
  EXPECT_EQ(hypotheses(), 2u * 16u);  // the first and the latest, 8 headings, upside down too
  recovery.Note({1.0, 0.9, 1.0}, Bent(0.1));  // 6 degrees: nothing new
  EXPECT_EQ(hypotheses(), 2u * 16u);
  recovery.Note({1.0, 0.9, 1.0}, Bent(0.6));
  recovery.Note({1.0, 0.2, 1.0}, Bent(1.2));  // new, but it agrees badly
  EXPECT_EQ(hypotheses(), 3u * 16u);
  recovery.Note({1.0, 0.9, 1.0}, Bent(1.2));
  recovery.Note({1.0, 0.9, 1.0}, Bent(-0.8));  // takes an older one's place
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
