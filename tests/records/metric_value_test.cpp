#include "records/metric_value.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"

namespace vitruvia {
namespace {

RunRecord Record() {
  RunRecord run;
  run.summary = {{"l2_mean_m", 0.01}, {"frame_ms_median", 5.0}, {"scene", "walk"}};
  run.provenance = {{"calibration_ms", 10.0}};
  run.frames = {{"frame_ms", {5.0}}, {"energy_data", {1.0}}};
  run.steps = {{"5 render", 2.0, 3.0, 4.0}};
  run.joint_error_mean_m = {{"left_wrist", 0.02}};
  return run;
}

TEST(MetricValue, ReadsSummaryStepsJointsAndCalibration) {
  const RunRecord run = Record();
  EXPECT_EQ(MetricValue(run, "l2_mean_m"), 0.01);
  EXPECT_EQ(MetricValue(run, kCalibratedTime), 0.5);
  EXPECT_EQ(MetricValue(run, "step_ms_median[5 render]"), 2.0);
  EXPECT_EQ(MetricValue(run, "step_ms_p95[5 render]"), 3.0);
  EXPECT_EQ(MetricValue(run, "step_ms_max[5 render]"), 4.0);
  EXPECT_EQ(MetricValue(run, "joint_error_mean_m[left_wrist]"), 0.02);
}

TEST(MetricValue, IsNanWhereTheRunHasNoNumberAndThrowsWhereThereIsNoMetric) {
  const RunRecord run = Record();
  for (const char* key : {"l2_max_m", "scene", "step_ms_median[7 classify]",
                          "joint_error_mean_m[neck]", "energy_data"}) {
    EXPECT_TRUE(std::isnan(MetricValue(run, key))) << key;
  }
  EXPECT_TRUE(std::isnan(MetricValue(RunRecord{}, kCalibratedTime)));
  EXPECT_THROW(MetricValue(run, "l2_meen_m"), ConfigError);
}

TEST(UnknownMetricsProblem, NamesTheFirstKeyThatTheCatalogueLacks) {
  RunRecord run = Record();
  EXPECT_EQ(UnknownMetricsProblem(run), "");
  run.frames["frame_mss"] = {1.0};
  EXPECT_EQ(UnknownMetricsProblem(run),
            "frames: unknown metric \"frame_mss\"; did you mean \"frame_ms\"?");
  run.summary["l2_meen_m"] = 1.0;
  EXPECT_EQ(UnknownMetricsProblem(run),
            "summary: unknown metric \"l2_meen_m\"; did you mean \"l2_mean_m\"?");
}

TEST(RepeatOf, IsOneUnlessTheRunSaysOtherwise) {
  RunRecord run = Record();
  EXPECT_EQ(RepeatOf(run), 1);
  run.summary["repeat"] = 3;
  EXPECT_EQ(RepeatOf(run), 3);
}

}  // namespace
}  // namespace vitruvia
