#include "reports/figures/sweep_figure.h"

#include <gmock/gmock.h>

#include "analysis/paired_comparison.h"
#include "analysis/variant_comparison.h"
#include "reports/figures/step_figure.h"

namespace vitruvia {
namespace {
using testing::ElementsAre;

RunRecord Swept(double edge, double weight, const std::string& scene, int seed, double error) {
  RunRecord run;
  run.variant = fmt::format("default,edge={},weight={}", edge, weight);
  run.method = "m";
  run.scene = scene;
  run.seed = seed;
  run.run_id = fmt::format("{}.{}.s{}", run.variant, scene, seed);
  run.config = {{"method", {{"settings", {{"edge", edge}, {"weight", weight}}}}}};
  run.summary = {{"l2_mean_of_diagonal", error}, {"frame_ms_median", 2.0 + edge}};
  return run;
}

SweptSetting Setting(const std::string& key, double usual) {
  return {"method.settings." + key, SweepScale::kLogarithmic, usual};
}

// Two scenes with two seeds at the edges 4, 1 and 2, in this order; the default is 2.
ReportedExperiment OneSetting() {
  ReportedExperiment experiment;
  experiment.record.sweep = {Setting("edge", 2.0)};
  for (const double edge : {4.0, 1.0, 2.0}) {
    for (const std::string scene : {"walk", "kick"}) {
      for (int seed = 1; seed <= 2; ++seed) {
        const double error = 0.01 * edge + (scene == "walk" ? 0.002 : 0.0) + 0.0001 * seed;
        const RunRecord run = Swept(edge, 1.0, scene, seed, error);
        experiment.runs.push_back({run.run_id, run, ""});
      }
    }
  }
  return experiment;
}

TEST(MakeSweepFigures, ShowsMeanIntervalScenesAndDefault) {
  const std::vector<Figure> figures = MakeSweepFigures(OneSetting());
  ASSERT_EQ(figures.size(), 1u);
  EXPECT_EQ(figures[0].name, "sweep-edge");
  ASSERT_EQ(figures[0].panels.size(), 2u);  // error and time
  const Panel& panel = figures[0].panels[0];
  EXPECT_EQ(panel.x_label, "edge");
  EXPECT_EQ(panel.x_scale, Scale::kLogarithmic);
  EXPECT_EQ(panel.x_references.at(0).label, "default: 2");
  EXPECT_EQ(panel.x_references.at(0).value, 2.0);
  ASSERT_EQ(panel.series.size(), 3u);  // two scenes and the mean
  EXPECT_EQ(panel.series[0].name, "kick");
  EXPECT_THAT(panel.series[0].x, ElementsAre(1.0, 2.0, 4.0));
  const Series& mean = panel.series[2];
  EXPECT_EQ(mean.name, "mean");
  EXPECT_NEAR(mean.y[0], 0.01 + 0.001 + 0.00015, 1e-12);
  const Interval expected = GroupedMeanInterval({{0.0101, 0.0102}, {0.0121, 0.0122}}, {});
  EXPECT_NEAR(mean.y_low[0], expected.low, 1e-12);
  EXPECT_NEAR(mean.y_high[0], expected.high, 1e-12);
}

TEST(MakeSweepFigures, TakesTheExperimentsColumnsAndNamesOfTexts) {
  ReportedExperiment experiment = OneSetting();
  experiment.record.table_columns = {"frame_ms_median"};
  for (ReportedRun& run : experiment.runs) {
    nlohmann::json& edge = run.record->config["method"]["settings"]["edge"];
    edge = edge == 1.0 ? "near" : "far";
  }
  const std::vector<Figure> figures = MakeSweepFigures(experiment);
  ASSERT_EQ(figures.at(0).panels.size(), 1u);
  ASSERT_EQ(figures[0].panels[0].x_ticks.size(), 2u);
  EXPECT_EQ(figures[0].panels[0].x_ticks[0].label, "far");
  EXPECT_TRUE(figures[0].panels[0].x_references.empty());  // the default was not swept
}

TEST(MakeSweepFigures, OfAGridIsAMapWithTheDefaultFramed) {
  ReportedExperiment experiment;
  experiment.record.sweep = {Setting("edge", 2.0), Setting("weight", 0.5)};
  for (const double edge : {1.0, 2.0, 4.0}) {
    for (const double weight : {0.5, 1.0}) {
      const RunRecord run = Swept(edge, weight, "walk", 1, 0.01 * edge * weight);
      experiment.runs.push_back({run.run_id, run, ""});
    }
  }
  const std::vector<Figure> figures = MakeSweepFigures(experiment);
  ASSERT_EQ(figures.size(), 3u);  // each setting alone, and both
  const Panel& panel = figures[2].panels.at(0);
  ASSERT_TRUE(panel.cells);
  EXPECT_THAT(panel.cells->values,
              ElementsAre(ElementsAre(0.005, 0.01, 0.02), ElementsAre(0.01, 0.02, 0.04)));
  EXPECT_EQ(panel.cells->framed, std::pair(1, 0));
  EXPECT_EQ(figures[0].panels[0].series.at(0).x.size(), 3u);  // at the default weight only
}

TEST(DefaultContender, HasAllSweptSettingsAtTheirDefaults) {
  const ReportedExperiment experiment = OneSetting();
  const std::vector<Contender> contenders = ContendersOf(experiment);
  EXPECT_EQ(DefaultContender(experiment, contenders), 2u);
  EXPECT_EQ(TabulateVariants(experiment).reference, "edge=2,weight=1");
  EXPECT_EQ(CompareVariants(experiment, "", {}).front().reference, "edge=2,weight=1");
}

TEST(MakeStepFigure, StacksTheStepsOfEachVariant) {
  ReportedExperiment experiment = OneSetting();
  EXPECT_FALSE(MakeStepFigure(experiment));
  for (ReportedRun& run : experiment.runs)
    run.record->steps = {{"search", 1.0 * run.record->seed, 9.0, 9.0}, {"solve", 4.0, 9.0, 9.0}};
  const auto figure = MakeStepFigure(experiment);
  ASSERT_TRUE(figure);
  const Panel& panel = figure->panels[0];
  ASSERT_EQ(panel.series.size(), 2u);
  EXPECT_THAT(panel.series[0].x, ElementsAre(1.5, 1.5, 1.5));  // the mean of both seeds
  EXPECT_EQ(panel.y_ticks[2].label, "edge=4,weight=1");        // the first variant is on top
}

}  // namespace
}  // namespace vitruvia
