// Agreement of model and frame, and detecting from it that the subject is lost.
#include "tracking/loss_detector.h"

#include <gtest/gtest.h>

namespace vitruvia {
namespace {

VertexClasses Classes(int near_surface, int elsewhere) {
  VertexClasses classes;
  classes.near_surface.resize(near_surface);
  classes.elsewhere.resize(elsewhere);
  return classes;
}

TEST(Agreement, CountsSharesOfTheCloudAndOfTheVisibleVertices) {
  const Agreement some = MeasureAgreement(200, 50, 80, Classes(30, 10));
  EXPECT_DOUBLE_EQ(some.explained, 0.75);
  EXPECT_DOUBLE_EQ(some.confirmed, 0.75);
  EXPECT_DOUBLE_EQ(some.visible_fraction_evaluated, 0.5);
  EXPECT_DOUBLE_EQ(some.score(), 0.75 * 0.75);
  EXPECT_DOUBLE_EQ(MeasureAgreement(0, 0, 40, Classes(30, 0)).score(), 0.0);
  EXPECT_DOUBLE_EQ(MeasureAgreement(200, 0, 40, Classes(0, 0)).score(), 0.0);
}

TEST(Agreement, IgnoresAnObjectBeforeTheBodyUnlessItHidesNearlyAll) {
  EXPECT_DOUBLE_EQ(MeasureAgreement(200, 150, 100, Classes(18, 2)).presence(), 0.9);
  EXPECT_DOUBLE_EQ(MeasureAgreement(200, 150, 1000, Classes(18, 2)).presence(), 0.25);
}

TEST(LossDetector, SearchesAfterPatienceFramesOfLowAgreementAndThenAfterEachPause) {
  RelocalizationSettings settings;
  settings.patience = 3;
  settings.pause = 2;
  settings.agreement_threshold = 0.7;
  LossDetector detector(settings);
  EXPECT_EQ(detector.Assess({1.0, 0.9, 1.0}), FrameVerdict::kAgrees);
  EXPECT_DOUBLE_EQ(detector.usual().presence(), 0.9);
  EXPECT_EQ(detector.Assess({1.0, 0.64, 1.0}), FrameVerdict::kAgrees);  // not below 0.7 · 0.9
  EXPECT_FALSE(detector.is_lost());
  std::vector<bool> searches;
  for (int i = 0; i < 6; ++i)
    searches.push_back(detector.Assess({1.0, 0.5, 1.0}) == FrameVerdict::kSearch);
  EXPECT_EQ(searches, (std::vector<bool>{false, false, true, false, true, false}));
  EXPECT_TRUE(detector.is_lost());
  detector.NoteFound({1.0, 0.95, 1.0});
  EXPECT_FALSE(detector.is_lost());
  EXPECT_DOUBLE_EQ(detector.usual().presence(), 0.95);
}

TEST(LossDetector, SearchesAtOnceAfterPatienceEmptyFrames) {
  LossDetector detector{RelocalizationSettings{.patience = 3}};
  detector.Assess({1.0, 1.0, 1.0});
  for (int i = 0; i < 3; ++i) detector.NoteEmptyFrame();
  EXPECT_TRUE(detector.is_lost());
  EXPECT_EQ(detector.Assess({0.7, 0.7, 1.0}), FrameVerdict::kSearch);
}

TEST(LossDetector, DoubtsABadFirstFrameAtOnceAndThenTakesItsLevelForUsual) {
  LossDetector detector{RelocalizationSettings{}};
  EXPECT_EQ(detector.Assess({1.0, 0.5, 1.0}), FrameVerdict::kSearch);
  EXPECT_EQ(detector.Assess({1.0, 0.5, 1.0}), FrameVerdict::kAgrees);
  EXPECT_FALSE(detector.is_lost());
  LossDetector never{RelocalizationSettings{.patience = 0}};
  EXPECT_EQ(never.Assess({1.0, 0.5, 1.0}), FrameVerdict::kDisagrees);
}

TEST(LossDetector, IsNotMisledByAnObjectBeforeTheBody) {
  LossDetector detector{RelocalizationSettings{}};
  detector.Assess({1.0, 1.0, 1.0});
  detector.Assess({0.2, 0.99, 0.9});  // a post: much is unexplained, but the model is confirmed
  EXPECT_FALSE(detector.is_lost());
  detector.Assess({0.7, 0.93, 0.9});  // the same product, missing on both sides
  EXPECT_TRUE(detector.is_lost());
  EXPECT_TRUE(IsClearlyBetter({0.9, 0.95, 0.9}, {0.7, 0.93, 0.9}, 0.1));
  EXPECT_FALSE(IsClearlyBetter({0.9, 0.95, 0.9}, {0.7, 0.93, 0.9}, 0.21));  // 0.855 − 0.651
  EXPECT_FALSE(IsClearlyBetter({0.9, 0.6, 0.9}, {0.2, 0.93, 0.9}, 0.1));    // the pose of the post
}

TEST(LossDetector, ReportsDoubtfulFramesWithoutSearching) {
  LossDetector detector{RelocalizationSettings{.agreement_threshold = 0.7, .doubt_threshold = 0.9}};
  detector.Assess({1.0, 1.0, 1.0});
  EXPECT_EQ(detector.Assess({1.0, 0.85, 1.0}), FrameVerdict::kAgrees);
  EXPECT_TRUE(detector.is_lost());
  EXPECT_EQ(detector.Assess({1.0, 0.95, 1.0}), FrameVerdict::kAgrees);
  EXPECT_FALSE(detector.is_lost());
}

// What the first frame shows may be a post.
TEST(LossDetector, DoesNotTakeABadFirstFrameForUsualBelowTheLeastLevel) {
  LossDetector detector{RelocalizationSettings{.least_usual = 0.9}};
  EXPECT_EQ(detector.Assess({1.0, 0.5, 1.0}), FrameVerdict::kSearch);
  EXPECT_EQ(detector.Assess({1.0, 0.5, 1.0}), FrameVerdict::kDisagrees);
  EXPECT_TRUE(detector.is_lost());
  detector.NoteFound({0.6, 0.98, 1.0});  // the person, whose cloud holds the post as well
  EXPECT_EQ(detector.Assess({0.6, 0.98, 1.0}), FrameVerdict::kAgrees);
  EXPECT_FALSE(detector.is_lost());
}

}  // namespace
}  // namespace vitruvia
