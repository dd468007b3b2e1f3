#include "analysis/variant_comparison.h"

#include <cmath>

#include <gmock/gmock.h>

#include "core/error.h"
#include "records/metric_value.h"
#include "reports/figures/speed_figure.h"
#include "reports/pages/comparison_section.h"

namespace vitruvia {
namespace {
using testing::ElementsAre;
using testing::HasSubstr;

RunRecord MakeRun(const std::string& variant, const std::string& scene, int seed, double error) {
  RunRecord run;
  run.variant = variant;
  run.method = "realtime_scape";
  run.scene = scene;
  run.seed = seed;
  run.run_id = fmt::format("{}.{}.s{}", variant, scene, seed);
  run.summary = {{"l2_mean_of_diagonal", error}, {"frame_ms_median", 5.0}};
  run.provenance = {{"calibration_ms", 10.0}};
  run.frames = {{"frame_ms", {4.0, 5.0, 6.0}}};
  return run;
}

void Add(ReportedExperiment& experiment, const RunRecord& run) {
  experiment.runs.push_back({run.run_id, run, ""});
}

// Three scenes and three seeds; "worse" is a thousandth above "base", "noisy" as often below.
ReportedExperiment NinePairs() {
  ReportedExperiment experiment;
  experiment.folder = "out/nine";
  for (const std::string scene : {"walk", "kick", "sit"}) {
    for (int seed = 1; seed <= 3; ++seed) {
      const double error = 0.01 * static_cast<double>(scene.size()) + 0.002 * seed;
      Add(experiment, MakeRun("base", scene, seed, error));
      Add(experiment, MakeRun("worse", scene, seed, error + 0.001 + 0.0001 * seed));
      Add(experiment, MakeRun("noisy", scene, seed, error + 0.001 * (seed - 2)));
    }
  }
  return experiment;
}

std::vector<std::string> Verdicts(const std::vector<VariantComparison>& rows,
                                  const std::string& metric) {
  std::vector<std::string> verdicts;
  for (const VariantComparison& row : rows) {
    if (row.metric.key == metric) verdicts.push_back(row.other + ": " + VerdictText(row));
  }
  return verdicts;
}

TEST(CompareVariants, PairsBySceneAndSeed) {
  const auto rows = CompareVariants(NinePairs(), "", {});
  EXPECT_THAT(Verdicts(rows, "l2_mean_of_diagonal"),
              ElementsAre("worse: higher (worse)", "noisy: difference not shown"));
  EXPECT_EQ(rows[0].comparison.difference.count, 9);
  EXPECT_EQ(rows[0].unpaired, 0);
  EXPECT_NEAR(rows[0].comparison.difference.mean, 0.0012, 1e-12);
  EXPECT_THAT(Verdicts(CompareVariants(NinePairs(), "worse", {}), "l2_mean_of_diagonal"),
              ElementsAre("base: lower (better)", "noisy: lower (better)"));
  EXPECT_THAT(Verdicts(rows, kCalibratedTime),
              ElementsAre("worse: difference not shown", "noisy: difference not shown"));
}

TEST(CompareVariants, SharesAreBetterWhereTheyAreHigher) {
  ReportedExperiment experiment;
  for (int seed = 1; seed <= 6; ++seed) {
    for (const std::string variant : {"a", "b"}) {
      RunRecord run = MakeRun(variant, "walk", seed, 0.1);
      run.summary["joints_within_10cm"] = variant == "a" ? 0.5 : 0.6;
      run.summary["joint_auc_30cm"] = variant == "a" ? 0.7 : 0.8;
      Add(experiment, run);
    }
  }
  for (const std::string metric : {"joints_within_10cm", "joint_auc_30cm"}) {
    EXPECT_THAT(Verdicts(CompareVariants(experiment, "", {metric}), metric),
                ElementsAre("b: higher (better)"));
  }
}

TEST(CompareVariants, CountsRunsWithoutAPartnerAndCallsNothingOfFewPairs) {
  ReportedExperiment experiment = NinePairs();
  std::erase_if(experiment.runs, [](const ReportedRun& run) {
    return run.record->variant == "worse" && run.record->scene != "walk";
  });
  experiment.runs.push_back({"worse.kick.s1", std::nullopt, "failed: something"});
  const auto rows = CompareVariants(experiment, "", {"l2_mean_of_diagonal"});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(VerdictText(rows[0]), "too few pairs");
  EXPECT_EQ(rows[0].comparison.difference.count, 3);
  EXPECT_EQ(rows[0].unpaired, 6);
}

TEST(CompareVariants, NamesWhatThereIsNot) {
  const auto message = [](const ReportedExperiment& experiment, const std::string& reference,
                          const std::vector<std::string>& metrics) {
    try {
      CompareVariants(experiment, reference, metrics);
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(message(NinePairs(), "bass", {}),
            "out/nine: no variant \"bass\"; there are: base, worse, noisy");
  EXPECT_EQ(message(NinePairs(), "", {"frame_ms_medium"}),
            "unknown metric \"frame_ms_medium\"; did you mean \"frame_ms_median\"?");
  EXPECT_EQ(message(NinePairs(), "", {"weight_error_kg"}),
            "metric \"weight_error_kg\": no pair of runs has it");
  ReportedExperiment one;
  one.folder = "out/one";
  Add(one, MakeRun("base", "walk", 1, 0.1));
  EXPECT_EQ(message(one, "", {}),
            "out/one: only one variant has finished runs; expected two at least");
}

TEST(ContendersOf, AreNamedByWhatTellsThemApart) {
  ReportedExperiment experiment;
  Add(experiment, MakeRun("default", "walk", 1, 0.1));
  Add(experiment, MakeRun("default", "walk", 1, 0.1));
  experiment.runs[1].record->method = "dynamic";
  EXPECT_EQ(ContendersOf(experiment)[1].name, "dynamic");
  Add(experiment, MakeRun("other", "walk", 1, 0.1));
  EXPECT_EQ(ContendersOf(experiment)[2].name, "realtime_scape/other");
}

TEST(CompareExperiments, PairsTheSameRunsOfTwoFolders) {
  const ReportedExperiment before = NinePairs();
  ReportedExperiment after = NinePairs();
  after.folder = "out/after";
  for (ReportedRun& run : after.runs) {
    run.record->summary["l2_mean_of_diagonal"] =
        run.record->summary["l2_mean_of_diagonal"].get<double>() * 0.9;
    run.record->summary["frame_ms_median"] = 10.0;  // on a machine half as fast
    run.record->provenance["calibration_ms"] = 20.0;
  }
  // Three scenes, whose means differ by 4.4, 4.4 and 3.4 thousandths: Student's p is 0.0067 with
  // two degrees of freedom, which four comparisons leave below 5 % and all metrics together do not.
  const auto of_error = CompareExperiments(before, after, {"l2_mean_of_diagonal"});
  EXPECT_THAT(Verdicts(of_error, "l2_mean_of_diagonal"),
              ElementsAre("out/after: realtime_scape/base: lower (better)",
                          "out/after: realtime_scape/worse: lower (better)",
                          "out/after: realtime_scape/noisy: lower (better)",
                          "out/after: all: lower (better)"));
  const auto rows = CompareExperiments(before, after, {});
  EXPECT_THAT(Verdicts(rows, "l2_mean_of_diagonal"),
              testing::Each(testing::EndsWith("difference not shown")));
  EXPECT_THAT(Verdicts(rows, "frame_ms_median"),
              testing::Contains("out/after: all: higher (worse)"));
  EXPECT_THAT(Verdicts(rows, kCalibratedTime),
              testing::Contains("out/after: all: difference not shown"));
  ReportedExperiment elsewhere;
  elsewhere.folder = "out/else";
  Add(elsewhere, MakeRun("base", "dance", 1, 0.1));
  EXPECT_THROW(CompareExperiments(before, elsewhere, {}), ConfigError);
}

TEST(ComparisonFiles, HoldEveryRow) {
  const auto rows = CompareVariants(NinePairs(), "", {"l2_mean_of_diagonal"});
  const nlohmann::json json = ToJson(rows);
  EXPECT_EQ(json.at("rows").size(), 2u);
  EXPECT_EQ(json.at("rows").at(0).at("verdict"), "higher (worse)");
  EXPECT_EQ(json.at("rows").at(0).at("pairs"), 9);
  EXPECT_EQ(json.at("rows").at(0).at("interval").at(0).get<double>(),
            rows[0].comparison.interval.low);
  const std::string csv = ToCsv(rows);
  EXPECT_THAT(csv, HasSubstr("l2_mean_of_diagonal,\"base\",\"worse\",9,0,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
}

TEST(ComparisonSection, ShowsIntervalsAndVerdicts) {
  const std::string html = ComparisonSection(NinePairs());
  EXPECT_THAT(html, HasSubstr("<h2>Variants against base</h2>"));
  EXPECT_THAT(html, HasSubstr("<td class=\"verdict missed\">higher (worse)</td>"));
  EXPECT_THAT(html, HasSubstr("<td class=\"soft\">difference not shown</td>"));
  ReportedExperiment one;
  Add(one, MakeRun("base", "walk", 1, 0.1));
  EXPECT_EQ(ComparisonSection(one), "");
}

TEST(MakeSpeedFigure, MarksTheFront) {
  ReportedExperiment experiment;
  const auto add = [&](const char* variant, double ms, double error) {
    for (int seed = 1; seed <= 2; ++seed) {
      RunRecord run = MakeRun(variant, "walk", seed, error + 0.002 * (seed - 1.5));
      run.frames = {{"frame_ms", {ms - 1.0, ms + 1.0}}};
      Add(experiment, run);
    }
  };
  add("fast", 2.0, 0.05);
  add("good", 9.0, 0.01);
  add("beaten", 10.0, 0.02);
  const Figure figure = MakeSpeedFigure(experiment);
  const Panel& panel = figure.panels[0];
  ASSERT_EQ(panel.series.size(), 4u);
  EXPECT_EQ(panel.series[0].name, "front");
  EXPECT_THAT(panel.series[0].x, ElementsAre(2.0, 9.0, 9.0));
  EXPECT_EQ(panel.series[0].y[1], panel.series[0].y[0]);  // steps
  EXPECT_DOUBLE_EQ(panel.series[1].y[0], 0.05);           // the mean of both seeds
  EXPECT_EQ(panel.series[1].x[0], 2.0);                   // the median of all frames
  EXPECT_EQ(panel.series[1].mark, Mark::kPoints);
  EXPECT_EQ(panel.series[2].mark, Mark::kPoints);
  EXPECT_EQ(panel.series[3].mark, Mark::kRings);
  EXPECT_THAT(figure.caption, HasSubstr("The calibration kernel took 10.00 ms"));
}

TEST(MakeSpeedFigure, KeepsAFewScenesApart) {
  ReportedExperiment experiment;
  const auto add = [&](const char* scene, double ms) {
    for (const char* variant : {"fast", "good"}) {
      RunRecord run = MakeRun(variant, scene, 1, 0.01);
      run.frames = {{"frame_ms", {variant == std::string("fast") ? ms : 2.0 * ms}}};
      Add(experiment, run);
    }
  };
  add("small", 2.0);
  EXPECT_EQ(MakeSpeedFigure(experiment).panels.size(), 1u);
  add("large", 50.0);
  const Figure figure = MakeSpeedFigure(experiment);
  ASSERT_EQ(figure.panels.size(), 2u);
  EXPECT_EQ(figure.panels[0].title, "small");
  EXPECT_EQ(figure.panels[1].title, "large");
  EXPECT_EQ(figure.panels[0].series[1].x[0], 4.0);
  EXPECT_EQ(figure.panels[1].series[1].x[0], 100.0);
  for (const char* scene : {"a", "b", "c"}) add(scene, 10.0);
  EXPECT_EQ(MakeSpeedFigure(experiment).panels.size(), 1u);  // over all five
}

TEST(TabulateVariants, GivesMeansOverAllRunsAndDifferencesToTheFirst) {
  const VariantTable table = TabulateVariants(NinePairs());
  ASSERT_EQ(table.metrics.size(), 2u);
  EXPECT_EQ(table.metrics[0].key, "l2_mean_of_diagonal");
  EXPECT_EQ(table.metrics[1].key, "frame_ms_median");
  ASSERT_EQ(table.rows.size(), 3u);
  const VariantSummary &base = table.rows[0], &worse = table.rows[1];
  EXPECT_EQ(base.name, "base");
  EXPECT_EQ(base.runs, 9);
  // Scenes of 4, 4 and 3 letters, seeds 1 to 3: the mean of 0.01 letters + 0.002 seed.
  EXPECT_NEAR(base.cells[0].spread.mean, 0.01 * 11.0 / 3.0 + 0.004, 1e-12);
  EXPECT_FALSE(base.cells[0].difference);
  EXPECT_NEAR(worse.cells[0].spread.mean, base.cells[0].spread.mean + 0.0012, 1e-12);
  ASSERT_TRUE(worse.cells[0].difference);
  const auto compared = CompareVariants(NinePairs(), "", {"l2_mean_of_diagonal"});
  EXPECT_EQ(worse.cells[0].difference->comparison.interval.low,
            compared[0].comparison.interval.low);
  EXPECT_EQ(worse.cells[0].difference->comparison.interval.high,
            compared[0].comparison.interval.high);
  EXPECT_EQ(VerdictText(*worse.cells[0].difference), "higher (worse)");
}

TEST(TabulateVariants, RunsWithoutPartnerCountInTheMeanOnly) {
  ReportedExperiment experiment = NinePairs();
  RunRecord alone = MakeRun("worse", "jump", 1, 1.0);
  Add(experiment, alone);
  const VariantSummary worse = TabulateVariants(experiment).rows[1];
  EXPECT_EQ(worse.runs, 10);
  EXPECT_EQ(worse.cells[0].spread.count, 10);
  EXPECT_EQ(worse.cells[0].difference->comparison.difference.count, 9);
  EXPECT_EQ(worse.cells[0].difference->unpaired, 1);
}

TEST(TabulateVariants, AsJson) {
  const nlohmann::json json = ToJson(TabulateVariants(NinePairs()));
  EXPECT_EQ(json.at("reference"), "base");
  EXPECT_EQ(json.at("confidence"), 0.95);
  ASSERT_EQ(json.at("rows").size(), 3u);
  EXPECT_FALSE(json["rows"][0]["metrics"]["l2_mean_of_diagonal"].contains("difference"));
  const nlohmann::json& noisy = json["rows"][2]["metrics"]["l2_mean_of_diagonal"];
  EXPECT_EQ(noisy.at("difference").at("verdict"), "difference not shown");
  EXPECT_EQ(noisy.at("difference").at("pairs"), 9);
  EXPECT_LT(noisy.at("difference").at("interval").at(0), 0.0);
  EXPECT_GT(noisy.at("difference").at("interval").at(1), 0.0);
}

TEST(VariantSection, IsThereForSeveralVariantsOnly) {
  const std::string html = VariantSection(NinePairs());
  EXPECT_THAT(html, HasSubstr("<h2>3 variants, 27 runs</h2>"));
  EXPECT_THAT(html, HasSubstr("<small class=\"verdict missed\" title=\"higher (worse)\">+0.00120"));
  ReportedExperiment one;
  Add(one, MakeRun("only", "walk", 1, 0.1));
  EXPECT_EQ(VariantSection(one), "");
}

}  // namespace
}  // namespace vitruvia
