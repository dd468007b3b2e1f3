// From the tracker's times to table 1: no published column may lose its step.
#include <cmath>

#include <gtest/gtest.h>

#include "analysis/tables.h"
#include "methods/realtime_scape/realtime_scape.h"
#include "support/arm_stage.h"

namespace vitruvia::realtime_scape {
namespace {

TEST(RealtimeScapeSteps, EveryPublishedColumnOfTable1FindsAStepOfTheTracker) {
  ArmStage stage(1, SkinLinear, {Vector3d(1, -1, -1).asDiagonal(), {0.05, 0.9, 2.8}});
  RealtimeScape tracker{Settings{}};
  tracker.Start(stage.body, stage.camera);
  RunRecord run;
  for (const NamedValue& step : tracker.TrackFrame(stage.Frame(0, 0.0)).step_ms) {
    run.steps.push_back({step.name, step.value, step.value, step.value});
  }
  int published = 0;
  double per_iteration_ms = 0.0, per_frame_ms = 0.0;
  std::vector<StepRow> rows = CompareSteps(run);
  EXPECT_EQ(rows.back().paper_per_frame_ms, 25.0);
  rows.pop_back();  // the whole frame
  for (const StepRow& row : rows) {
    if (std::isnan(row.paper_per_frame_ms)) continue;
    ++published;
    per_frame_ms += row.paper_per_frame_ms;
    if (!std::isnan(row.paper_per_iteration_ms)) per_iteration_ms += row.paper_per_iteration_ms;
  }
  EXPECT_EQ(published, 8);
  EXPECT_NEAR(per_iteration_ms, 6.0, 1e-9);          // 0.5 + 1.5 + 0.3 + 1.8 + 0.9 + 0.6 + 0.4
  EXPECT_NEAR(per_frame_ms, 4.2 + 3.5 * 6.0, 1e-9);  // 3.5 iterations
}

}  // namespace
}  // namespace vitruvia::realtime_scape
