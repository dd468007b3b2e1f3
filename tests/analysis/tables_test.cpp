#include "analysis/tables.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "analysis/metrics_page.h"
#include "core/error.h"
#include "core/files.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(PrintedMetric, IsInTheUnitsOfTheReader) {
  EXPECT_EQ(Titled(FindMetric("l2_mean_m")), "mean L2 error (mm)");
  EXPECT_EQ(Printed(0.00123, FindMetric("l2_mean_m")), "1.23");
  EXPECT_EQ(Printed(0.987, FindMetric("joints_within_10cm")), "98.70");
  EXPECT_EQ(PrintedSigned(-0.0005, FindMetric("l2_mean_of_diagonal")), "−0.00050");
  EXPECT_EQ(PrintedSigned(2.0, FindMetric("frame_ms_p95")), "+2.0");
  EXPECT_EQ(PrintedCell(nullptr, FindMetric("l2_mean_m")), "–");
  EXPECT_EQ(PrintedCell(300, FindMetric("frames")), "300");
}

TEST(PrintedMetric, IsExplainedWithUnitAndDirection) {
  EXPECT_EQ(Explanation(FindMetric("frame_ms_p95")),
            "frame_ms_p95\n  time per frame, 95th percentile\n  95th percentile over the frames of "
            "frame_ms.\n  formula: p95_f t_f\n  over:    the frames\n  counts:  Lost and failed "
            "frames count like all others.\n  unit:    ms\n  better:  lower is better\n");
  EXPECT_THAT(Explanation(FindMetric("joints_within_10cm")),
              testing::HasSubstr("  unit:    % in tables; stored value × 100\n"
                                 "  better:  higher is better\n"));
  EXPECT_THAT(Explanation(FindMetric("frames")),
              testing::EndsWith("tracked frames.\n  formula: F\n  counts:  Lost and failed frames "
                                "count like all others.\n  better:  neither is better\n"));
}

TEST(MetricsPage, IsTheOneInDocs) {
  EXPECT_EQ(ReadWholeFile(std::filesystem::path(VITRUVIA_SOURCE_DIR) / "docs/metrics.md"),
            MetricsPage())
      << "vitruvia explain --metrics > docs/metrics.md renews it";
}

TEST(MetricsPage, HasEveryMetric) {
  const std::string page = MetricsPage();
  for (const auto& metrics : {MetricCatalogue(), MetricFamilies()}) {
    for (const Metric& metric : metrics)
      EXPECT_THAT(page, testing::HasSubstr(fmt::format("\n### `{}`\n", metric.key)));
  }
}

ReportedExperiment WithOneRun(double paper, double at_most, nlohmann::json ours) {
  ReportedExperiment experiment;
  experiment.record.expectations = {{"l2_mean_of_diagonal", paper, at_most, "paper A", ""}};
  ReportedRun run;
  run.run_id = "a";
  run.record.emplace();
  run.record->run_id = "a";
  run.record->summary = {{"l2_mean_of_diagonal", std::move(ours)}};
  experiment.runs.push_back(run);
  return experiment;
}

TEST(CompareWithPapers, JudgesByTheTargetAlone) {
  const auto verdict = [](double at_most, nlohmann::json ours) {
    return CompareWithPapers(WithOneRun(0.001, at_most, std::move(ours)))[0].runs[0].verdict;
  };
  EXPECT_EQ(verdict(0.002, 0.0015), Verdict::kMet);
  EXPECT_EQ(verdict(0.002, 0.002), Verdict::kMet);
  EXPECT_EQ(verdict(0.002, 0.0021), Verdict::kMissed);
  EXPECT_EQ(verdict(kNan, 0.5), Verdict::kNoTarget);
  EXPECT_EQ(verdict(0.002, nullptr), Verdict::kNoResult);
}

TEST(CompareSteps, SetsTable1BesideOurs) {
  RunRecord run;
  run.summary = {{"frame_ms_median", 9.0}, {"frame_ms_p95", 12.0}};
  run.frames["frame_ms"] = {8.0, 13.5, 9.0};
  run.steps = {{"2 kd-tree of P", 2.0, 2.5, 3.0},
               {"8 correspond", 4.0, 5.0, 6.0},
               {"own step", 1.0, 1.0, 1.0}};
  const std::vector<StepRow> rows = CompareSteps(run);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_TRUE(std::isnan(rows[0].paper_per_iteration_ms));
  EXPECT_EQ(rows[0].paper_per_frame_ms, 4.2);
  EXPECT_EQ(rows[1].paper_per_iteration_ms, 1.8);
  EXPECT_DOUBLE_EQ(rows[1].paper_per_frame_ms, 6.3);
  EXPECT_EQ(rows[1].p95_ms, 5.0);
  EXPECT_TRUE(std::isnan(rows[2].paper_per_frame_ms));
  EXPECT_EQ(rows[3].name, "whole frame");
  EXPECT_EQ(rows[3].paper_per_frame_ms, 25.0);
  EXPECT_EQ(rows[3].median_ms, 9.0);
  EXPECT_EQ(rows[3].max_ms, 13.5);
}

TEST(CompareSteps, MethodsOfOtherPapersGetNoNumbersOfPaperA) {
  RunRecord run;
  run.steps = {{"own step", 1.0, 1.0, 1.0}};
  EXPECT_TRUE(std::isnan(CompareSteps(run).back().paper_per_frame_ms));
}

TEST(SummaryTable, HasTheLeadingColumnsFirstAndTheOthersInTheOrderOfTheCatalogue) {
  ReportedExperiment experiment = WithOneRun(0.001, kNan, 0.5);
  experiment.runs[0].record->summary["energy_mean"] = 1.5;
  experiment.runs[0].record->summary["diagonal_m"] = 2.5;
  const SummaryTable table = MakeSummaryTable(experiment);
  std::vector<std::string> keys;
  for (const Metric& column : table.columns) keys.push_back(column.key);
  EXPECT_THAT(keys,
              testing::ElementsAre("run_id", "l2_mean_of_diagonal", "diagonal_m", "energy_mean"));
  EXPECT_THAT(table.rows[0].cells, testing::ElementsAre("a", 0.5, 2.5, 1.5));
}

TEST(ReadExperiment, NamesARecordWithANumberThatTheCatalogueDoesNotKnow) {
  const TemporaryFolder folder;
  ExperimentRecord experiment;
  experiment.run_ids = {"a"};
  WriteExperimentRecord(folder.path(), experiment);
  RunRecord run;
  run.run_id = "a";
  run.summary = {{"l2_mean_m", 0.01}};
  WriteRunRecord(folder.path(), run);
  Json stored = ReadJsonFile(folder / "a/record.json");
  stored["summary"] = {{"l2_meen_m", 0.01}};
  WriteWholeFile(folder / "a/record.json", stored.dump());
  const ReportedExperiment read = ReadExperiment(folder.path());
  EXPECT_FALSE(read.runs.at(0).record.has_value());
  EXPECT_THAT(read.runs.at(0).problem,
              testing::HasSubstr("summary: unknown metric \"l2_meen_m\"; did you mean"));
}

}  // namespace
}  // namespace vitruvia
