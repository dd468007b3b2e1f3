#include "metrics/catalogue.h"

#include <set>

#include <gmock/gmock.h>

#include "core/error.h"

namespace vitruvia {
namespace {
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::vector<Metric> All() {
  std::vector<Metric> all = MetricCatalogue();
  all.insert(all.end(), MetricFamilies().begin(), MetricFamilies().end());
  return all;
}

std::string WhatFindSays(const std::string& key) {
  try {
    FindMetric(key);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "found";
}

TEST(MetricCatalogue, DescribesEachKeyOnceAndWhole) {
  std::set<std::string> keys;
  for (const Metric& metric : All()) {
    EXPECT_TRUE(keys.insert(metric.key).second) << metric.key << " stands twice";
    EXPECT_THAT(metric.label, Not(IsEmpty())) << metric.key;
    EXPECT_TRUE(metric.definition.ends_with('.')) << metric.key << ": " << metric.definition;
    EXPECT_GT(metric.scale, 0.0) << metric.key;
    EXPECT_GE(metric.decimals, 0) << metric.key;
  }
}

TEST(MetricCatalogue, SaysHowANumberWithADirectionIsComputedAndWhatCounts) {
  for (const Metric& metric : All()) {
    const bool is_time_or_cost = metric.unit == "ms" || metric.unit == "s";
    if (metric.better == Better::kNeither || is_time_or_cost) continue;
    EXPECT_THAT(metric.formula, Not(IsEmpty())) << metric.key;
    if (metric.formula.starts_with("mean") || metric.formula.starts_with("median")) {
      EXPECT_THAT(metric.averaged_over, Not(IsEmpty())) << metric.key;
    }
  }
  for (const Metric& metric : MetricsShownIn(Place::kComparison)) {
    const bool is_of_a_body = metric.key.ends_with("error_m") || metric.key.ends_with("error_kg");
    if (!is_of_a_body) {
      EXPECT_TRUE(metric.hidden_and_lost.ends_with('.')) << metric.key;
    }
  }
}

TEST(MetricCatalogue, KnowsDirectionsThatNoNameTells) {
  EXPECT_EQ(FindMetric("joint_auc_30cm").better, Better::kHigher);
  EXPECT_EQ(FindMetric("joints_within_10cm").better, Better::kHigher);
  EXPECT_EQ(FindMetric("l2_mean_m").better, Better::kLower);
  EXPECT_EQ(FindMetric("frame_ms_median").better, Better::kLower);
  EXPECT_EQ(FindMetric("diagonal_m").better, Better::kNeither);
  EXPECT_EQ(FindMetric("frames_to_recover").better, Better::kNeither);  // -1 is the worst
}

TEST(MetricCatalogue, RefusesAnUnknownKeyWithTheNearest) {
  EXPECT_EQ(WhatFindSays("l2_mean_m"), "found");
  EXPECT_EQ(WhatFindSays("frame_ms_medium"),
            "unknown metric \"frame_ms_medium\"; did you mean \"frame_ms_median\"?");
  EXPECT_EQ(WhatFindSays("wobble"),
            "unknown metric \"wobble\"; vitruvia explain lists all metrics");
  // Neither an ending nor a word inside makes a metric of a name.
  EXPECT_THAT(WhatFindSays("solve_ms"), HasSubstr("unknown metric"));
  EXPECT_THAT(WhatFindSays("joints_hidden_within_5cm"), HasSubstr("unknown metric"));
  EXPECT_EQ(WhatFindSays("step_ms_medain[7 classify]"),
            "unknown metric \"step_ms_medain[7 classify]\"; did you mean \"step_ms_median[7 "
            "classify]\"?");
  EXPECT_EQ(UnknownMetricProblem("l2_mean_m"), "");
}

TEST(MetricCatalogue, FillsInTheMemberOfAFamily) {
  const Metric step = FindMetric("step_ms_median[7 classify]");
  EXPECT_EQ(step.key, "step_ms_median[7 classify]");
  EXPECT_EQ(step.label, "time of step 7 classify per frame, median");
  EXPECT_EQ(step.family, kStepMedian);
  EXPECT_EQ(step.member, "7 classify");
  EXPECT_EQ(step.better, Better::kLower);
  EXPECT_EQ(FindMetric("joint_error_mean_m[left_wrist]").family, kJointErrorOfJoint);
  EXPECT_EQ(FindMetric("energy_data").family, kEnergyOfTerm);
  EXPECT_EQ(FindMetric("energy_rise").family, "");  // a metric of its own, not a term "rise"
  EXPECT_THAT(WhatFindSays("step_ms_median[]"), HasSubstr("unknown metric"));
  EXPECT_THAT(WhatFindSays("joint_error_mean_m[left_wrist"), HasSubstr("unknown metric"));
}

TEST(MetricCatalogue, SelectionsHaveTheDirectionThatTheyNeed) {
  for (const Metric& metric : MetricsShownIn(Place::kGate))
    EXPECT_NE(metric.better, Better::kNeither) << metric.key;
  // Both axes of the Pareto front are costs.
  for (const Place place : {Place::kSpeedPlot, Place::kHistoryPlot}) {
    EXPECT_FALSE(MetricsShownIn(place).empty());
    for (const Metric& metric : MetricsShownIn(place))
      EXPECT_EQ(metric.better, Better::kLower) << metric.key;
  }
}

}  // namespace
}  // namespace vitruvia
