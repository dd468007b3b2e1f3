#include "scoring/run_health.h"

#include <limits>

#include <gtest/gtest.h>

namespace vitruvia {
namespace {

// Eight frames: lost by its own word in 2, by its error in 3 and 4.
RunRecord Record() {
  RunRecord record;
  record.frames = {{"failed", {0, 0, 1, 0, 0, 0, 0, 0}},
                   {"l2_mean_visible_m", {0.001, 0.002, 0.01, 0.06, 0.07, 0.01, 0.01, 0.01}},
                   {"condition", {10, 20, 90, 30, 30, 30, 30, 30}},
                   {"weak_directions", {0, 0, 2, 0, 0, 0, 0, 0}},
                   {"agreeing_digits", {14, 14, 9, 14, 14, 14, 14, 14}},
                   {"rotation_drift", {0, 0, 1e-16, 0, 0, 0, 0, 2e-16}},
                   {"energy_fit", {1, 1, 1, 1, 1, 1, 1, 9}},
                   {"energy_joint", {2, 2, 2, 2, 2, 2, 2, 2}}};
  return record;
}

TEST(RunHealth, CountsLostFramesUntilTheSubjectIsFoundAgain) {
  nlohmann::json row;
  SummarizeHealth(Record(), row);
  EXPECT_EQ(row.at("frames_lost"), 3);
  EXPECT_EQ(row.at("frames_to_recover"), 3);
  EXPECT_EQ(row.at("frames_to_notice"), 2) << "frames 3 and 4 are off and not told";
  EXPECT_EQ(row.at("condition_max"), 90.0);
  EXPECT_EQ(row.at("weak_directions_max"), 2.0);
  EXPECT_EQ(row.at("agreeing_digits_min"), 9.0);
  EXPECT_EQ(row.at("rotation_drift_max"), 2e-16);
  EXPECT_EQ(row.at("non_finite"), 0);
  RunRecord to_the_end = Record();
  to_the_end.frames["failed"].back() = 1.0;
  SummarizeHealth(to_the_end, row);
  EXPECT_EQ(row.at("frames_lost"), 4);
  EXPECT_EQ(row.at("frames_to_recover"), -1);
}

TEST(RunHealth, FrameWithoutVisibleSurfaceIsNeitherLostNorFoundAgain) {
  constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();
  RunRecord record = Record();  // lost in frames 2 to 4
  record.frames["l2_mean_visible_m"][5] = kAbsent;
  nlohmann::json row;
  SummarizeHealth(record, row);
  EXPECT_EQ(row.at("frames_lost"), 3);
  EXPECT_EQ(row.at("frames_to_recover"), 3);
  for (std::size_t frame = 5; frame < 8; ++frame)
    record.frames["l2_mean_visible_m"][frame] = kAbsent;
  SummarizeHealth(record, row);
  EXPECT_EQ(row.at("frames_lost"), 3);
  EXPECT_EQ(row.at("frames_to_recover"), -1);  // nobody saw the tracker find the subject again
  record.frames["failed"][6] = 1.0;
  SummarizeHealth(record, row);
  EXPECT_EQ(row.at("frames_lost"), 4);
}

TEST(RunHealth, CountsInfiniteNumbersAndNotAbsentOnes) {
  RunRecord record = Record();
  record.frames["condition"][1] = std::numeric_limits<double>::infinity();
  record.frames["energy_fit"][1] = std::numeric_limits<double>::quiet_NaN();
  nlohmann::json row;
  SummarizeHealth(record, row);
  EXPECT_EQ(row.at("non_finite"), 1);
  EXPECT_EQ(row.at("condition_max"), std::numeric_limits<double>::infinity());
  EXPECT_NEAR(row.at("energy_mean"), 15.0 / 7.0 + 2.0, 1e-12);  // fit: of seven frames
}

TEST(RunHealth, TellsOfEnergyWhereSomebodyLooked) {
  RunRecord record = Record();
  nlohmann::json row;
  SummarizeHealth(record, row);
  EXPECT_EQ(row.at("energy_mean"), 4.0);  // of fit 2, of joint 2
  EXPECT_FALSE(row.contains("energy_rises"));
  record.frames["energy_rise"] = {0, 1e-12, 0, 0.25, 0, 0.5, 0, 0};
  SummarizeHealth(record, row);
  EXPECT_EQ(row.at("energy_rises"), 2);  // rounding is none
  EXPECT_EQ(row.at("energy_rise_max"), 0.5);
  EXPECT_EQ(row.at("energy_mean"), 4.0);
}

}  // namespace
}  // namespace vitruvia
