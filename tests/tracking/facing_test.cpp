// When another facing is tried, and what it must reach.
#include "tracking/facing.h"

#include <vector>

#include <gtest/gtest.h>

namespace vitruvia {
namespace {

constexpr double kUsual_m2 = 1e-5, kMargin_m2 = 3.6e-5;

TEST(FacingWatch, IsDueWhenTheGapExceedsTheUsualOneByTheMarginInSquare) {
  FacingWatch watch(FacingSettings{.margin_m = 0.006});
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(watch.IsDue(kUsual_m2));
  EXPECT_FALSE(watch.IsDue(kUsual_m2 + 0.99 * kMargin_m2));
  EXPECT_TRUE(watch.IsDue(kUsual_m2 + 1.1 * kMargin_m2));  // the usual gap has followed a little
}

TEST(FacingWatch, AGapThatWasTriedInVainRaisesTheUsualOne) {
  FacingWatch watch(FacingSettings{.margin_m = 0.006});
  watch.IsDue(kUsual_m2);
  const double gap_m2 = kUsual_m2 + 1.9 * kMargin_m2;
  ASSERT_TRUE(watch.IsDue(gap_m2));
  watch.NoteTrial(false);
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(watch.IsDue(gap_m2));
}

TEST(FacingWatch, TriesALargeGapAgainAfterPausesThatDouble) {
  FacingWatch watch(FacingSettings{.margin_m = 0.006, .least_decrease = 0.35, .pause = 2});
  watch.IsDue(kUsual_m2);
  std::vector<int> due_frames;
  for (int i = 0; i < 16; ++i) {
    if (!watch.IsDue(1e-3)) continue;
    due_frames.push_back(i);
    watch.NoteTrial(false);
  }
  EXPECT_EQ(due_frames, (std::vector<int>{0, 2, 6, 14}));
}

TEST(FacingWatch, AGapThatAnotherFacingClosedStaysUnusual) {
  FacingWatch watch(FacingSettings{.margin_m = 0.006});
  watch.IsDue(kUsual_m2);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(watch.IsDue(1e-3));
    watch.NoteTrial(true);
  }
}

TEST(FacingWatch, DemandsMarginAndShare) {
  const FacingWatch watch(FacingSettings{.margin_m = 0.006, .least_decrease = 0.35});
  EXPECT_DOUBLE_EQ(watch.GapToBeat(5e-5), 5e-5 - kMargin_m2);  // less than 65 %
  EXPECT_DOUBLE_EQ(watch.GapToBeat(1e-3), 0.65e-3);
}

TEST(HalfTurn, KeepsItsCenterAndTheVerticalAndReversesTheFront) {
  const Matrix3<double> camera_from_rest = Vector3d(1, -1, -1).asDiagonal();
  const Vector3d center(0.1, 0.2, 3.0);
  const Rigidd turn = HalfTurn(camera_from_rest, center);
  EXPECT_LT((turn * center - center).norm(), 1e-12);
  const Matrix3<double> turned = turn.rotation * camera_from_rest;
  EXPECT_LT((turned.col(1) - camera_from_rest.col(1)).norm(), 1e-12);
  EXPECT_LT((turned.col(2) + camera_from_rest.col(2)).norm(), 1e-12);
}

}  // namespace
}  // namespace vitruvia
