#include "reports/pages/index_page.h"

#include <cmath>

#include <gmock/gmock.h>

#include "analysis/gate_reports.h"
#include "config/stored_data.h"
#include "core/error.h"
#include "core/files.h"
#include "reports/figures/history_figure.h"
#include "reports/synthetic_experiment.h"
#include "support/count.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

RunRecord IndexedRun(const std::string& id, double error) {
  RunRecord run;
  run.run_id = id;
  run.variant = id;
  run.scene = "walk";
  run.method = "realtime_scape";
  run.provenance = {{"commit", "abc123"}};
  run.summary = {{"l2_mean_of_diagonal", error}, {"frames", 12}};
  return run;
}

IndexedExperiment Experiment() {
  IndexedExperiment indexed;
  indexed.link = "walks/report.html";
  indexed.experiment.record.name = "walks";
  indexed.experiment.record.title = "Walks & <turns>";
  indexed.experiment.runs = {{"a", IndexedRun("a", 0.0005), ""},
                             {"b", IndexedRun("b", 0.002), ""},
                             {"c", std::nullopt, "failed: no pose"}};
  return indexed;
}

std::string PageWith(const Expectation& expectation) {
  IndexContent content;
  content.experiments = {Experiment()};
  content.experiments[0].experiment.record.expectations = {expectation};
  return MakeIndexPage(content);
}

TEST(MakeIndexPage, SetsPublishedOursAndVerdictInOneRow) {
  const std::string some =
      PageWith({"l2_mean_of_diagonal", 0.001, 0.001, "paper A, figure 11", ""});
  EXPECT_THAT(some, HasSubstr("data-value=\"0.001\">0.00100</td>"));
  EXPECT_THAT(some, HasSubstr(">0.00050 … 0.00200</td>"));
  EXPECT_THAT(some, HasSubstr("✗ 1 of 3 met"));
  const std::string all = PageWith({"l2_mean_of_diagonal", 0.001, 0.003, "paper A, figure 11", ""});
  EXPECT_THAT(all, HasSubstr("✗ 2 of 3 met"));  // the third has no result
  const std::string none = PageWith({"l2_mean_of_diagonal", 0.001, NAN, "paper A, figure 11", ""});
  EXPECT_THAT(none, HasSubstr("no target"));
  EXPECT_THAT(PageWith({"frame_ms_median", 25, 25, "paper A, table 1", ""}),
              HasSubstr("no result"));
}

TEST(MakeIndexPage, SaysWhyANumberIsNotComparable) {
  const std::string page = PageWith(
      {"l2_mean_of_diagonal", 0.001, 0.001, "paper B, table 1", "", "its data is not published"});
  EXPECT_THAT(page, HasSubstr("not comparable because its data is not published"));
  EXPECT_THAT(page, Not(HasSubstr(" of 3 met")));
}

TEST(MakeIndexPage, ListsEveryRunAndEscapesWhatOthersWrote) {
  IndexContent content;
  content.experiments = {Experiment()};
  content.problems = {"out/x/experiment.json: not JSON"};
  const std::string page = MakeIndexPage(content);
  EXPECT_THAT(page, HasSubstr("<a href=\"walks/report.html\">Walks &amp; &lt;turns&gt;</a>"));
  EXPECT_THAT(page, HasSubstr("2 of 3 runs finished, <b class=\"missed\">1 failed or missing</b>"));
  EXPECT_THAT(page, HasSubstr("failed: no pose"));
  EXPECT_THAT(page, HasSubstr("out/x/experiment.json: not JSON"));
  EXPECT_EQ(Count(page, "<td class=\"run\""), 3u);
}

std::vector<HistoryEntry> ThreeNights() {
  std::vector<HistoryEntry> history;
  for (const char* commit : {"aaa", "bbb", "ccc"}) {
    GatedRun run{"nightly/clean", "short", "walk", "realtime_scape", 1, 3, {}, {}, {}};
    run.accuracy = {{"l2_mean_m", 0.001 * static_cast<double>(history.size() + 1)}};
    run.times_ms = {{kWholeFrame, {0.4, 0.5, 0.7}}};
    history.push_back({"2026-01-0" + std::to_string(history.size() + 1),
                       commit,
                       history.size() < 2 ? "one" : "other",
                       0,
                       {run}});
  }
  history[1].runs.clear();  // nothing was measured that night
  return history;
}

TEST(MakeHistoryFigures, DrawsALineForEveryRunWithGaps) {
  const auto figures = MakeHistoryFigures(ThreeNights());
  ASSERT_EQ(figures.size(), 1u);
  EXPECT_EQ(figures[0].name, "history-nightly-clean");
  ASSERT_EQ(figures[0].panels.size(), 2u);
  const Series& line = figures[0].panels[0].series.at(0);
  EXPECT_EQ(line.name, "short.walk.realtime_scape.s1");
  EXPECT_EQ(line.y[0], 1.0);  // mm
  EXPECT_TRUE(std::isnan(line.y[1]));
  EXPECT_EQ(line.y[2], 3.0);
  // A line for each machine, with the medians over the repeats.
  ASSERT_EQ(figures[0].panels[1].series.size(), 2u);
  EXPECT_EQ(figures[0].panels[1].series[0].name, "short.walk.realtime_scape.s1 on one");
  EXPECT_EQ(figures[0].panels[1].series[0].y[0], 0.5);
  EXPECT_TRUE(std::isnan(figures[0].panels[1].series[0].y[2]));
  EXPECT_EQ(figures[0].panels[1].series[1].y[2], 0.5);
  EXPECT_EQ(figures[0].panels[0].x_label, "measurement (number; 1: 2026-01-01, 3: 2026-01-03)");
  EXPECT_TRUE(MakeHistoryFigures({}).empty());
}

RegressionFile OkGate() {
  RegressionFile file;
  file.name = "Nightly";
  file.verdict = "ok: 3 numbers";
  file.date = "d";
  file.commit = "ccc";
  return file;
}

TEST(WriteIndex, FindsExperimentsAndGatesAndSurvivesDamage) {
  const TemporaryFolder root;
  WriteSyntheticExperiment(root.path());
  fs::create_directories(root / "damaged");
  WriteWholeFile(root / "damaged/experiment.json", "{");
  fs::create_directories(root / "nightly/repeat-1/clean");
  WriteWholeFile(root / "nightly/repeat-1/clean/experiment.json", "not looked at");
  WriteStored(root / "nightly/regression.json", OkGate());
  WriteHistory(root / "nightly/history.json", ThreeNights());
  const std::string page = ReadWholeFile(WriteIndex(root.path()));
  EXPECT_THAT(page, HasSubstr("1 experiments; 3 of 5 runs finished"));
  EXPECT_THAT(page, HasSubstr("damaged/experiment.json: not valid JSON"));
  EXPECT_THAT(page, Not(HasSubstr("repeat-1")));
  EXPECT_THAT(page,
              HasSubstr("<b class=\"met\">ok: 3 numbers</b> on d at commit <code>ccc</code>"));
  EXPECT_THAT(page, HasSubstr("aria-label=\"nightly/clean\""));
  EXPECT_TRUE(fs::exists(root / "nightly/history-nightly-clean.png"));
}

TEST(WriteIndex, RefusesFoldersWithNothingToShow) {
  const TemporaryFolder root;
  EXPECT_THAT([&] { WriteIndex(root.path()); },
              testing::ThrowsMessage<DataError>(HasSubstr("holds no experiment")));
  EXPECT_THAT([&] { WriteIndex(root / "nowhere"); },
              testing::ThrowsMessage<DataError>(HasSubstr("expected a folder of experiments")));
}

}  // namespace
}  // namespace vitruvia
