#include "analysis/text_table.h"

#include <gmock/gmock.h>

#include "analysis/tables.h"
#include "analysis/variant_comparison.h"

namespace vitruvia {
namespace {
using testing::HasSubstr;
using testing::Not;

TEST(ToLatex, EscapesAndSetsTypographicSigns) {
  const TextTable table{
      {"variant", "error (%)"}, {{{"a_b"}, {"−1.5 ± 0.2", true}}}, {"Mean of three."}};
  EXPECT_EQ(ToLatex(table),
            "% Mean of three.\n\\begin{tabular}{lr}\n\\toprule\nvariant & error \\\\\n"
            " & (\\%) \\\\\n\\midrule\na\\_b & \\textbf{\\boldmath $-$1.5 $\\pm$ 0.2} "
            "\\\\\n\\bottomrule\n"
            "\\end{tabular}\n");
  EXPECT_EQ(LatexEscaped("≥ 5 – “x”"), "$\\ge$ 5 -- “x”");
}

TEST(ToLatex, SetsARowOfOneCellOverAllColumns) {
  const TextTable table{{"variant", "n"}, {{{"error (mm)"}}, {{"a"}, {"1"}}, {{"b"}}}, {}};
  EXPECT_EQ(ToLatex(table),
            "\\begin{tabular}{lr}\n\\toprule\nvariant & n \\\\\n\\midrule\n"
            "\\multicolumn{2}{l}{\\emph{error (mm)}} \\\\\na & 1 \\\\\n"
            "\\addlinespace\n\\multicolumn{2}{l}{\\emph{b}} \\\\\n\\bottomrule\n\\end{tabular}\n");
  EXPECT_THAT(ToMarkdown(table), HasSubstr("| error (mm) | |\n| a | 1 |\n"));
}

TEST(ToMarkdown, KeepsBarsInsideCells) {
  const TextTable table{{"a", "b|c"}, {{{"x"}, {"1", true}}}, {"A note."}};
  EXPECT_EQ(ToMarkdown(table), "| a | b\\|c |\n|---|---:|\n| x | **1** |\n\nA note.\n");
}

// Six scenes; "good" is better by the same share in each, "same" differs by noise of either sign.
ReportedExperiment ThreeVariants() {
  ReportedExperiment experiment;
  experiment.record.name = "three";
  for (int scene = 0; scene < 6; ++scene) {
    for (const std::string variant : {"base", "same", "good"}) {
      RunRecord run;
      run.variant = variant;
      run.method = "m";
      run.scene = fmt::format("s{}", scene);
      run.seed = 1;
      run.run_id = variant + run.scene;
      const double base = 0.01 * (1 + scene);
      run.summary = {{"l2_mean_m", variant == "good"   ? 0.5 * base + 0.001 * scene
                                   : variant == "same" ? base + (scene % 2 == 0 ? 1e-4 : -1e-4)
                                                       : base},
                     {"frame_ms_median", variant == "good" ? 9.0 : 5.0}};
      experiment.runs.push_back({run.run_id, run, ""});
    }
  }
  return experiment;
}

TEST(VariantTableText, IsBoldOnlyWhereTheBestIsShownToBeBetter) {
  ReportedExperiment experiment = ThreeVariants();
  experiment.record.table_columns = {"l2_mean_m", "frame_ms_median"};
  const TextTable table = ToText(TabulateVariants(experiment), "variant");
  EXPECT_THAT(table.head, testing::ElementsAre("variant", "n", "mean L2 error (mm)",
                                               "time per frame, median (ms)"));
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(table.rows[0][1].text, "6");
  EXPECT_TRUE(table.rows[2][2].bold);   // good
  EXPECT_FALSE(table.rows[0][3].bold);  // two are equally fast
  EXPECT_FALSE(table.rows[1][3].bold);
}

TEST(VariantTableText, OfASingleVariantHasARowForEachScene) {
  ReportedExperiment experiment = ThreeVariants();
  std::erase_if(experiment.runs, [](const auto& run) { return run.record->variant != "base"; });
  experiment.record.table_columns = {"l2_mean_m"};
  const std::string latex = ToLatex(experiment);
  EXPECT_THAT(latex, HasSubstr("scene & n & mean L2 error \\\\\n &  & (mm) \\\\"));
  EXPECT_THAT(latex, HasSubstr("s3 & 1 & 40.00 \\\\"));
  EXPECT_THAT(latex, Not(HasSubstr("paper")));  // no table of papers without a published number
}

TEST(ComparisonText, HasTheReferenceFirstAndSaysHowDifferencesAreCalled) {
  const TextTable table = ToText(CompareVariants(ThreeVariants(), "", {"l2_mean_m"}));
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_EQ(table.rows[0][0].text, "mean L2 error (mm)");
  EXPECT_EQ(table.rows[1][0].text, "base");
  EXPECT_EQ(table.rows[1][2].text, "reference");
  EXPECT_EQ(table.rows[2][0].text, "same");
  EXPECT_FALSE(table.rows[2][2].bold);
  EXPECT_EQ(table.rows[3][0].text, "good");
  EXPECT_TRUE(table.rows[3][2].bold);
  EXPECT_EQ(table.rows[3][4].text, "6");
  EXPECT_THAT(table.notes.at(0), HasSubstr("n: pairs, of 6 scenes"));
  EXPECT_THAT(table.notes.at(1), HasSubstr("Holm's correction for 2 comparisons"));
}

TEST(ComparisonText, TakesTheColumnsOfTheExperimentsTable) {
  ReportedExperiment experiment = ThreeVariants();
  experiment.record.table_columns = {"joint_error_mean_m", "frame_ms_median"};  // no run has joints
  const std::vector<VariantComparison> rows = CompareVariants(experiment, "", {});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].metric.key, "frame_ms_median");
  EXPECT_EQ(rows[1].metric.key, "frame_ms_median");
}

TEST(ComparisonText, NamesASettingOnceWhereAllVariantsAreItsValues) {
  ReportedExperiment experiment = ThreeVariants();
  for (ReportedRun& run : experiment.runs) run.record->variant = "gain=" + run.record->variant;
  const TextTable comparison = ToText(CompareVariants(experiment, "", {"l2_mean_m"}));
  EXPECT_EQ(comparison.head[0], "gain");
  EXPECT_EQ(comparison.rows[3][0].text, "good");
  const TextTable table = ToText(TabulateVariants(experiment), "variant");
  EXPECT_EQ(table.head[0], "gain");
  EXPECT_EQ(table.rows[2][0].text, "good");
}

TEST(VariantTableText, WithoutAFinishedRunSaysWhatBecameOfEach) {
  ReportedExperiment experiment = ThreeVariants();
  experiment.runs = {{"base.s0", std::nullopt, "failed: no body"}};
  EXPECT_THAT(ToLatex(experiment),
              HasSubstr("run & status \\\\\n\\midrule\nbase.s0 & failed: no body \\\\"));
}

}  // namespace
}  // namespace vitruvia
