// The page of reproduced figures, from records made for the purpose.
#include "reports/pages/reproduction_page.h"

#include <gmock/gmock.h>

#include "core/files.h"
#include "records/bone_tree.h"
#include "reports/figures/contender_plots.h"
#include "reports/figures/tree_drawing.h"
#include "reports/synthetic_experiment.h"
#include "support/count.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {
using testing::HasSubstr;
using testing::Not;

class ReproductionPage : public testing::Test {
 protected:
  ReproductionPage() {
    list_.title = "Made <anew>";
    ClaimTest test;
    test.metric = "joint_error_mean_m";
    test.of = "*";
    test.at_most = 0.5;
    test.paper = 0.02;
    test.remark = "a bound of ours";
    ReproducedFigure figure;
    figure.id = "A11";
    figure.place = "Paper A, figure 11";
    figure.title = "ground truth";
    figure.caption = "What is shown";
    figure.published = "a curve";
    figure.claim = "it works & holds";
    figure.experiments = {"experiment.json"};
    figure.tests = {test};
    figure.pictures = {{"*", {}, {}, {kPictureFrame}, {"depth", "error"}, false}};
    figure.plots = {"joint-accuracy", kJointsByScene};
    figure.tables = {{.title = "Errors", .metrics = {"joint_error_mean_m"}}};
    list_.figures = {figure};
  }

  // Of the runs of that scene only.
  FigureRecords Records(const std::string& scene) const {
    return {list_.figures.front(), {RunsThatMatch(experiment_, "*", {scene})}, {}};
  }

  std::string Page(const FigureRecords& records) const {
    WriteReproductionPage(list_, {records}, root_ / "page/index.html");
    return ReadWholeFile(root_ / "page/index.html");
  }

  TemporaryFolder root_;
  ReproductionList list_;
  ReportedExperiment experiment_ = ReadExperiment(WriteSyntheticExperiment(root_.path()));
};

TEST_F(ReproductionPage, ShowsCaptionPublishedOursAndVerdict) {
  const std::string page = Page(Records("wave"));
  for (const char* words :
       {"Made &lt;anew&gt;", "Paper A, figure 11: ground truth", "What is shown", "a curve",
        "it works &amp; holds", "20.00 mm", "a bound of ours", "<b class=\"verdict met\">holds</b>",
        "mean joint error: * ≤ 500.00 mm", "<h3>Errors</h3>"})
    EXPECT_THAT(page, HasSubstr(words));
  // Two runs, two of a strip's seven pictures each.
  EXPECT_EQ(Count(page, "<img src=\"data:image/png;base64,"), 4u);
  EXPECT_EQ(Count(page, "<figure class=\"plot\">"), 2u);
  EXPECT_TRUE(std::filesystem::exists(root_ / "page/index/A11-1-joints-by-scene.svg"));
  EXPECT_THAT(page, Not(HasSubstr("src=\"http")));
}

TEST_F(ReproductionPage, ShowsTheChosenSeedsAndTheScaleOfErrorsWhereItShowsErrors) {
  FigureRecords records = Records("wave");
  EXPECT_THAT(Page(records), HasSubstr("<div class=\"bar\">error (mm)"));
  records.figure.pictures.front().panels = {"depth"};
  EXPECT_THAT(Page(records), Not(HasSubstr("<div class=\"bar\">error (mm)")));
  records.figure.pictures.front().seeds = {99};
  EXPECT_EQ(Count(Page(records), "<img src=\"data:image/png;base64,"), 0u);
}

TEST_F(ReproductionPage, SaysWhyAClaimIsNotTested) {
  FigureRecords records = Records("wave");
  records.problems = {"no such data"};
  EXPECT_THAT(Page(records),
              HasSubstr("<b class=\"soft\">cannot be tested here</b>: no such data"));
  records = {list_.figures.front(), {experiment_}, {}};
  EXPECT_THAT(Page(records), HasSubstr("2 of 5 runs have no record"));
}

TEST_F(ReproductionPage, CountsTheVerdicts) {
  FigureRecords refuted = Records("wave");
  refuted.figure.tests.front().at_most = 0.0;
  WriteReproductionPage(list_, {refuted, Records("wave")}, root_ / "page/index.html");
  EXPECT_THAT(ReadWholeFile(root_ / "page/index.html"),
              HasSubstr("Of 2 figures and tables the claim <b class=\"met\">holds</b> in 1, <b "
                        "class=\"missed\">does not hold here</b> in 1"));
}

TEST(ContenderPlots, AverageOverRunsAndStandSceneBesideScene) {
  ReportedExperiment experiment;
  for (const auto& [scene, share] : {std::pair{"a", 0.5}, std::pair{"b", 1.0}}) {
    RunRecord run;
    run.run_id = scene;
    run.method = "m";
    run.variant = "v";
    run.scene = scene;
    run.threshold_m = {0.0, 0.1};
    run.joint_accuracy = {{"all", {0.0, share}}};
    run.summary = {{"joints_within_10cm", share}};
    experiment.runs.push_back({scene, run, ""});
  }
  const std::vector<Figure> plots = MakeContenderPlots(experiment);
  ASSERT_EQ(plots.size(), 2u);
  ASSERT_EQ(plots[0].panels.size(), 1u);  // no run has the curve less the offset
  EXPECT_EQ(plots[0].panels[0].series.at(0).y, (std::vector<double>{0.0, 75.0}));
  const Series& bars = plots[1].panels.at(0).series.at(0);
  ASSERT_EQ(bars.y.size(), 10u);
  EXPECT_EQ(bars.y[1], 50.0);
  EXPECT_EQ(bars.y[6], 100.0);
  ASSERT_EQ(plots[1].panels[0].x_ticks.size(), 2u);
  EXPECT_EQ(plots[1].panels[0].x_ticks[1].label, "b");
}

TEST(TreeDrawing, GrowsWithDepthAndLeaves) {
  BoneTree tree{"t", {{"root", "", -1}}};
  const TreeSize one = SizeOf(tree);
  tree.nodes.push_back({"left", "", 0});
  const TreeSize chain = SizeOf(tree);
  EXPECT_GT(chain.width, one.width);
  EXPECT_EQ(chain.height, one.height);
  tree.nodes.push_back({"right", "", 0});
  EXPECT_EQ(SizeOf(tree).width, chain.width);
  EXPECT_GT(SizeOf(tree).height, chain.height);
}

TEST(BoneTree, RefusesAChildBeforeItsParent) {
  EXPECT_EQ((BoneTree{"t", {{"a", "", -1}, {"b", "", 0}}}.Problem()), "");
  EXPECT_THAT((BoneTree{"t", {{"a", "", -1}, {"b", "", 1}}}.Problem()), HasSubstr("nodes[1]"));
  EXPECT_THAT((BoneTree{"t", {{"a", "", 0}}}.Problem()), HasSubstr("nodes[0]"));
  EXPECT_NE((BoneTree{"t", {}}.Problem()), "");
}

}  // namespace
}  // namespace vitruvia
