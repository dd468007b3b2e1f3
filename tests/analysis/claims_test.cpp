// Verdicts on claims, on records made for the purpose.
#include "analysis/claims.h"

#include <cmath>

#include <gmock/gmock.h>

#include "analysis/figure_records.h"
#include "config/json_settings.h"

namespace vitruvia {
namespace {
using testing::HasSubstr;

struct MadeRun {
  std::string method, variant, scene;
  int seed = 1;
  double error_m = 0.0;
};

ReportedExperiment Made(const std::vector<MadeRun>& runs) {
  ReportedExperiment experiment;
  experiment.record.name = "made";
  for (const MadeRun& run : runs) {
    RunRecord record;
    record.run_id = "r" + std::to_string(experiment.runs.size());
    record.method = run.method;
    record.variant = run.variant;
    record.scene = run.scene;
    record.seed = run.seed;
    record.summary = {{"joint_error_mean_m", run.error_m}};
    experiment.runs.push_back({record.run_id, record, ""});
  }
  return experiment;
}

// Two methods on `pairs` seeds: ours has the errors 10, 11, … mm, the other `worse_m` more, with a
// spread of ±1 mm.
ReportedExperiment Pairs(int pairs, double worse_m, int first_seed = 0) {
  std::vector<MadeRun> runs;
  for (int seed = first_seed; seed < first_seed + pairs; ++seed) {
    const double ours = 0.010 + 0.001 * seed;
    runs.push_back({"ours", "v", "s", seed, ours});
    runs.push_back({"other", "v", "s", seed, ours + worse_m + (seed % 2 == 0 ? 0.001 : -0.001)});
  }
  return Made(runs);
}

ClaimTest Bound(double at_most) {
  ClaimTest test;
  test.metric = "joint_error_mean_m";
  test.of = "ours/*";
  test.at_most = at_most;
  return test;
}

ClaimTest Paired(ClaimRelation relation, double margin = kAbsent) {
  ClaimTest test;
  test.metric = "joint_error_mean_m";
  test.relation = relation;
  test.of = "ours/*";
  test.against = "other/*";
  test.margin = margin;
  return test;
}

TEST(ClaimBound, IsHeldAgainstTheMeanOfTheChosenRuns) {
  const std::vector<ReportedExperiment> made = {Made(
      {{"ours", "v", "a", 1, 0.010}, {"ours", "v", "b", 1, 0.030}, {"other", "v", "a", 1, 0.500}})};
  EXPECT_EQ(Decide(Bound(0.020), made).verdict, ClaimVerdict::kHolds);
  EXPECT_EQ(Decide(Bound(0.0199), made).verdict, ClaimVerdict::kDoesNotHold);
  ClaimTest only_a = Bound(0.010);
  only_a.scenes = {"a*"};
  EXPECT_EQ(Decide(only_a, made).verdict, ClaimVerdict::kHolds);
  EXPECT_EQ(Decide(only_a, made).ours, "10.00 mm");
  EXPECT_EQ(Decide(Bound(0.020), made).ours, "20.00 mm (10.00 … 30.00, 2 runs)");
  only_a.scenes = {"c"};
  EXPECT_EQ(Decide(only_a, made).verdict, ClaimVerdict::kCannotBeTested);
  EXPECT_THAT(Decide(only_a, made).reason, HasSubstr("no run of ours/*"));
}

TEST(ClaimBound, FromBelowAndWithThePublishedValue) {
  ClaimTest test = Bound(kAbsent);
  test.at_least = 0.015;
  test.paper = 0.02;
  const ClaimFinding finding = Decide(test, {Made({{"ours", "v", "a", 1, 0.014}})});
  EXPECT_EQ(finding.verdict, ClaimVerdict::kDoesNotHold);
  EXPECT_EQ(finding.published, "20.00 mm");
  EXPECT_EQ(finding.statement, "mean joint error: ours/* ≥ 15.00 mm");
  EXPECT_EQ(finding.reason, "below the bound by 1.00 mm");
}

TEST(ClaimBetter, NeedsAnIntervalOnTheRightSideOfZero) {
  const ClaimTest better = Paired(ClaimRelation::kBetter);
  EXPECT_EQ(Decide(better, {Pairs(8, 0.005)}).verdict, ClaimVerdict::kHolds);
  EXPECT_EQ(Decide(better, {Pairs(8, 0.005)}).reason, "");
  const ClaimFinding worse = Decide(better, {Pairs(8, -0.005)});
  EXPECT_EQ(worse.verdict, ClaimVerdict::kDoesNotHold);
  EXPECT_EQ(worse.reason, "it is worse");
  const ClaimFinding alike = Decide(better, {Pairs(8, 0.0)});
  EXPECT_EQ(alike.verdict, ClaimVerdict::kDoesNotHold);
  EXPECT_EQ(alike.reason, "the interval holds 0");
}

// Differences of three scenes are 1, 1 and 8 mm: resampled means are all positive, but of three
// values so far apart Student's test says nothing.
TEST(ClaimBetter, NeedsStudentsTestOverTheScenesToo) {
  std::vector<MadeRun> runs;
  for (const auto& [scene, worse_m] : {std::pair{"a", 0.001}, {"b", 0.001}, {"c", 0.008}}) {
    for (int seed = 0; seed < 2; ++seed) {
      runs.push_back({"ours", "v", scene, seed, 0.010});
      runs.push_back({"other", "v", scene, seed, 0.010 + worse_m});
    }
  }
  const ClaimFinding finding = Decide(Paired(ClaimRelation::kBetter), {Made(runs)});
  EXPECT_EQ(finding.verdict, ClaimVerdict::kDoesNotHold);
  EXPECT_THAT(finding.reason, HasSubstr("by Student's test over 3 scenes"));
}

TEST(ClaimBetter, IsNotDecidedByFewPairs) {
  const ClaimFinding finding = Decide(Paired(ClaimRelation::kBetter), {Pairs(5, 0.5)});
  EXPECT_EQ(finding.verdict, ClaimVerdict::kCannotBeTested);
  EXPECT_THAT(finding.reason, HasSubstr("5 pairs"));
  // Pairs of several experiments add up.
  EXPECT_EQ(Decide(Paired(ClaimRelation::kBetter), {Pairs(3, 0.5), Pairs(3, 0.5, 3)}).verdict,
            ClaimVerdict::kHolds);
}

// Eight seeds of a scene without noise: one sequence, so one pair.
TEST(ClaimBetter, CountsSeedsThatChangeNothingOnce) {
  std::vector<MadeRun> runs;
  for (int seed = 0; seed < 8; ++seed) {
    runs.push_back({"ours", "v", "s", seed, 0.010});
    runs.push_back({"other", "v", "s", seed, 0.020});
  }
  ReportedExperiment made = Made(runs);
  EXPECT_EQ(Decide(Paired(ClaimRelation::kBetter), {made}).verdict, ClaimVerdict::kHolds);
  for (ReportedRun& run : made.runs) run.record->sequence_hash = "one";
  const ClaimFinding finding = Decide(Paired(ClaimRelation::kBetter), {made});
  EXPECT_EQ(finding.verdict, ClaimVerdict::kCannotBeTested);
  EXPECT_THAT(finding.reason, HasSubstr("1 pairs"));
}

TEST(ClaimBetter, SaysWhichMethodHasNoRuns) {
  const ClaimFinding finding =
      Decide(Paired(ClaimRelation::kBetter), {Made({{"ours", "v", "s", 1, 0.01}})});
  EXPECT_EQ(finding.verdict, ClaimVerdict::kCannotBeTested);
  EXPECT_THAT(finding.reason, HasSubstr("no run of other/*"));
}

TEST(ClaimAlike, NeedsAnIntervalWithinTheMargin) {
  EXPECT_EQ(Decide(Paired(ClaimRelation::kAlike, 0.010), {Pairs(8, 0.005)}).verdict,
            ClaimVerdict::kHolds);
  EXPECT_EQ(Decide(Paired(ClaimRelation::kAlike, 0.005), {Pairs(8, 0.005)}).verdict,
            ClaimVerdict::kDoesNotHold);
  EXPECT_EQ(Decide(Paired(ClaimRelation::kAlike, 0.005), {Pairs(8, 0.005)}).reason,
            "the interval leaves the margin");
}

TEST(ClaimPairs, PreferTheSameMethodAndThenTheSameVariant) {
  ClaimTest test = Paired(ClaimRelation::kBetter);
  test.of = "*/with";
  test.against = "*/without";
  std::vector<MadeRun> runs;
  for (int seed = 0; seed < 6; ++seed) {
    for (const std::string method : {"a", "b"}) {
      const double base = method == "a" ? 0.1 : 0.2;
      runs.push_back({method, "with", "s", seed, base});
      runs.push_back({method, "without", "s", seed, base + 0.01});
    }
  }
  const ClaimFinding finding = Decide(test, {Made(runs)});
  EXPECT_EQ(finding.verdict, ClaimVerdict::kHolds);
  EXPECT_THAT(finding.ours, HasSubstr("12 pairs"));
  EXPECT_THAT(finding.ours, HasSubstr("difference −10.00"));
}

TEST(Claim, HoldsIfAllTestsHold) {
  const std::vector<ReportedExperiment> made = {Made({{"ours", "v", "a", 1, 0.010}})};
  const ClaimTest untestable = Paired(ClaimRelation::kBetter);
  EXPECT_EQ(Decide({Bound(0.02), Bound(0.03)}, made).verdict, ClaimVerdict::kHolds);
  const ClaimDecision refuted = Decide({Bound(0.02), Bound(0.001)}, made);
  EXPECT_EQ(refuted.verdict, ClaimVerdict::kDoesNotHold);
  EXPECT_EQ(refuted.reason,
            "mean joint error: ours/* ≤ 1.00 mm (above the bound by 9.00 mm); 1 of 2 tests hold");
  EXPECT_EQ(Decide({Bound(0.02), untestable}, made).verdict, ClaimVerdict::kCannotBeTested);
  // What is refuted stays refuted, whatever else could not be tested.
  EXPECT_EQ(Decide({untestable, Bound(0.001)}, made).verdict, ClaimVerdict::kDoesNotHold);
  EXPECT_EQ(Decide(std::vector<ClaimTest>{}, made).verdict, ClaimVerdict::kCannotBeTested);
}

TEST(FigureDecision, IsNotTakenWhileRunsAreMissing) {
  FigureRecords records;
  records.figure.tests = {Bound(0.02)};
  records.experiments = {Made({{"ours", "v", "a", 1, 0.010}})};
  EXPECT_EQ(DecideFigure(records).verdict, ClaimVerdict::kHolds);
  records.experiments[0].runs.push_back({"r9", std::nullopt, "failed: no body"});
  const ClaimDecision decision = DecideFigure(records);
  EXPECT_EQ(decision.verdict, ClaimVerdict::kCannotBeTested);
  EXPECT_EQ(decision.reason, "1 of 2 runs have no record; r9: failed: no body");
}

TEST(FigureTable, HasMeansOfEachContenderInItsScenes) {
  const ReportedExperiment made = Made({{"ours", "v", "a", 1, 0.010},
                                        {"ours", "v", "a", 2, 0.020},
                                        {"ours", "v", "b", 1, 0.900},
                                        {"other", "v", "a", 1, 0.040}});
  const ShownTable table{
      "t", TableRows::kContenders, {"a"}, {"joint_error_mean_m", "frame_ms_median"}};
  const std::vector<TableRow> rows = Tabulate(table, {made});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].name, "ours/v");
  EXPECT_EQ(rows[0].runs, 2);
  EXPECT_DOUBLE_EQ(rows[0].means[0], 0.015);
  EXPECT_TRUE(std::isnan(rows[0].means[1]));
  EXPECT_EQ(rows[1].name, "other/v");
}

TEST(FigureTable, HasOneRowForAMethodOverItsVariants) {
  const ReportedExperiment made = Made({{"ours", "man", "a", 1, 0.010},
                                        {"ours", "woman", "a", 1, 0.030},
                                        {"other", "man", "a", 1, 0.040}});
  const ShownTable table{"t", TableRows::kMethods, {}, {"joint_error_mean_m"}};
  const std::vector<TableRow> rows = Tabulate(table, {made});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].name, "ours");
  EXPECT_DOUBLE_EQ(rows[0].means[0], 0.020);
}

std::string RefusalOf(const Json& test) {
  try {
    ReadSettings<ClaimTest>(test, {"list.json", ""});
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(ClaimTest, IsReadStrictly) {
  const Json bound = {{"metric", "joint_error_mean_m"}, {"of", "*"}, {"at_most", 1}};
  EXPECT_EQ(RefusalOf(bound), "");
  Json test = bound;
  test["metrik"] = "x";
  EXPECT_THAT(RefusalOf(test), HasSubstr("metrik"));
  test = bound;
  test["metric"] = "joint_error_meen_m";
  EXPECT_THAT(RefusalOf(test), HasSubstr("did you mean \"joint_error_mean_m\""));
  test = bound;
  test["at_least"] = 0;
  EXPECT_THAT(RefusalOf(test), HasSubstr("expected one of at_most and at_least"));
  test = bound;
  test["against"] = "*";
  EXPECT_THAT(RefusalOf(test), HasSubstr("neither \"against\" nor \"margin\""));
  test = {{"metric", "joint_error_mean_m"}, {"of", "*"}, {"relation", "better"}};
  EXPECT_THAT(RefusalOf(test), HasSubstr("relation better: expected \"against\""));
  test["against"] = "*";
  EXPECT_EQ(RefusalOf(test), "");
  test["metric"] = "iterations_mean";
  EXPECT_THAT(RefusalOf(test), HasSubstr("no better direction"));
  test = {{"metric", "joint_error_mean_m"}, {"of", "*"}, {"relation", "alike"}, {"against", "*"}};
  EXPECT_THAT(RefusalOf(test), HasSubstr("relation alike: expected \"margin\""));
}

}  // namespace
}  // namespace vitruvia
