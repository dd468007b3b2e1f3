#include "analysis/judgement.h"

#include <gmock/gmock.h>

#include "analysis/gate_reports.h"
#include "core/files.h"
#include "support/count.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

constexpr const char* kWalk = "nightly: default.walk.realtime_scape.s1";
constexpr const char* kRender = "5 render";
constexpr const char* kUpdate = "11 update";

RunRecord Record(double error_m, double frame_ms) {
  RunRecord record;
  record.run_id = "default.walk.realtime_scape.s1.0123abcd";
  record.variant = "default";
  record.scene = "walk";
  record.method = "realtime_scape";
  record.seed = 1;
  record.summary = {{"l2_mean_m", error_m},
                    {"frames_failed", 0},
                    {"joints_within_10cm", 0.9},
                    {"frame_ms_median", frame_ms}};
  record.steps = {{kRender, 0.5 * frame_ms, 0, 0}, {kUpdate, 0.01 * frame_ms, 0, 0}};
  return record;
}

// A run whose repeats differ in their times only.
GatedRun Gated(const RunRecord& record, const std::vector<double>& factors = {1.0}) {
  std::vector<RunRecord> repeats;
  for (const double factor : factors) {
    RunRecord& repeat = repeats.emplace_back(record);
    const double frame_ms = record.summary.at("frame_ms_median");
    repeat.summary["frame_ms_median"] = factor * frame_ms;
    for (RunRecord::Step& step : repeat.steps) step.median_ms *= factor;
  }
  return MakeGatedRun("nightly", repeats);
}

GateBaseline BaselineOf(const GatedRun& run) { return {"2026-01-01", "base000", "cpu", {}, {run}}; }

// Without a program of the baseline.
Judgement JudgeOf(const GatedRun& was, const GatedRun& is,
                  const std::vector<HistoryEntry>& history = {}) {
  return Judge(BaselineOf(was), {{is}, {}}, {{}, "", "no program"}, {}, history, "now0000");
}

// Of the same accuracy; `was` was carried out in turn with `is`.
Judgement JudgeSpeed(const GatedRun& was, const GatedRun& is) {
  return Judge(BaselineOf(is), {{is}, {}}, {{was}, "base000", ""}, {}, {}, "now0000");
}

TEST(MakeGatedRun, KeepsTheTimesOfEveryRepeat) {
  std::vector repeats = {Record(0.01, 6.0), Record(0.01, 50.0), Record(0.01, 14.0)};
  repeats[1].steps.pop_back();  // of the short step
  const GatedRun run = MakeGatedRun("nightly", repeats);
  EXPECT_EQ(run.name(), kWalk);
  EXPECT_EQ(run.repeats, 3);
  EXPECT_THAT(run.times_ms.at(kWholeFrame), ElementsAre(6.0, 50.0, 14.0));
  EXPECT_THAT(run.times_ms.at(kRender), ElementsAre(3.0, 25.0, 7.0));
  EXPECT_FALSE(run.times_ms.contains(kUpdate));
  EXPECT_EQ(run.accuracy.at("l2_mean_m"), 0.01);
  EXPECT_FALSE(run.accuracy.contains("frame_ms_median"));
  EXPECT_THAT(run.unsteady, IsEmpty());
}

TEST(Judge, ComparesNoTimesWithoutAProgramOfTheBaseline) {
  const Judgement judgement = JudgeOf(Gated(Record(0.01, 6.0)), Gated(Record(0.01, 60.0)));
  EXPECT_EQ(judgement.Code(), ExitCode::kSuccess);
  EXPECT_EQ(judgement.findings.size(), 3u);  // accuracies
  EXPECT_EQ(judgement.speed_not_judged, "no program");
  EXPECT_THAT(Headline(judgement), HasSubstr("; speed not judged: no program"));
}

TEST(Judge, AccuracyIsHeldTightly) {
  const GatedRun was = Gated(Record(0.01, 6.0));
  EXPECT_EQ(JudgeOf(was, Gated(Record(0.010009, 6.0))).Code(), ExitCode::kSuccess);
  const Judgement worse = JudgeOf(was, Gated(Record(0.010011, 6.0)));
  EXPECT_EQ(worse.Code(), ExitCode::kAccuracyRegressed);
  const auto regressions = worse.Regressions(NumberKind::kAccuracy);
  ASSERT_EQ(regressions.size(), 1u);
  EXPECT_EQ(regressions[0]->metric, "l2_mean_m");
  EXPECT_EQ(regressions[0]->was, 0.01);
  EXPECT_EQ(regressions[0]->is, 0.010011);
  EXPECT_DOUBLE_EQ(regressions[0]->limit, 0.01001);
}

TEST(Judge, OneFailedFrameMoreAndFewerJointsFoundAreRegressions) {
  const GatedRun was = Gated(Record(0.01, 6.0));
  RunRecord record = Record(0.01, 6.0);
  record.summary["frames_failed"] = 1;
  EXPECT_EQ(JudgeOf(was, Gated(record)).Code(), ExitCode::kAccuracyRegressed);
  record = Record(0.01, 6.0);
  record.summary["joints_within_10cm"] = 0.89;
  EXPECT_EQ(JudgeOf(was, Gated(record)).Code(), ExitCode::kAccuracyRegressed);
  record.summary["joints_within_10cm"] = 0.91;
  const Judgement better = JudgeOf(was, Gated(record));
  EXPECT_EQ(better.Code(), ExitCode::kSuccess);
  ASSERT_EQ(better.OfChange(Change::kImproved).size(), 1u);
  EXPECT_EQ(better.OfChange(Change::kImproved)[0]->metric, "joints_within_10cm");
}

const std::vector<double> kSevenTimes = {1.0, 1.02, 0.98, 1.01, 0.99, 1.0, 1.03};

RunRecord WithSlowerRender(double factor) {
  RunRecord record = Record(0.01, 6.0);
  record.steps[0].median_ms *= factor;
  return record;
}

TEST(Judge, AStepSlowedByTenPercentIsASpeedRegression) {
  const GatedRun was = Gated(Record(0.01, 6.0), kSevenTimes);
  const Judgement judgement = JudgeSpeed(was, Gated(WithSlowerRender(1.1), kSevenTimes));
  EXPECT_EQ(judgement.Code(), ExitCode::kSpeedRegressed);
  const auto regressions = judgement.Regressions(NumberKind::kSpeed);
  ASSERT_EQ(regressions.size(), 1u);
  EXPECT_EQ(regressions[0]->metric, kRender);
  EXPECT_DOUBLE_EQ(regressions[0]->was, 3.0);
  EXPECT_DOUBLE_EQ(regressions[0]->is, 3.3);
  EXPECT_DOUBLE_EQ(regressions[0]->ratio.low, 1.1);  // of pairs: the machine's swing cancels
  EXPECT_DOUBLE_EQ(regressions[0]->ratio.high, 1.1);
  EXPECT_EQ(regressions[0]->blame.first_bad, "");
}

TEST(Judge, TimesThatTakeLittleOfAFrameAreNotGated) {
  const GatedRun was = Gated(Record(0.01, 6.0), kSevenTimes);
  RunRecord record = Record(0.01, 6.0);
  record.steps[1].median_ms *= 1.3;
  EXPECT_EQ(JudgeSpeed(was, Gated(record, kSevenTimes)).Code(), ExitCode::kSuccess);
}

TEST(Judge, TwiceAsFastIsToldAndNoReasonToFail) {
  const GatedRun was = Gated(Record(0.01, 6.0), kSevenTimes);
  const Judgement faster = JudgeSpeed(was, Gated(Record(0.01, 3.0), kSevenTimes));
  EXPECT_EQ(faster.Code(), ExitCode::kSuccess);
  EXPECT_EQ(faster.OfChange(Change::kImproved).size(), 2u);
}

// Pairs on a busy machine: ratios from 0.7 to 1.6 about 1 say nothing.
TEST(Judge, NoiseIsNoRegression) {
  const GatedRun was = Gated(Record(0.01, 6.0), std::vector<double>(7, 1.0));
  const GatedRun is = Gated(Record(0.01, 6.0), {1.6, 0.7, 1.2, 0.95, 1.3, 1.1, 1.15});
  const Judgement judgement = JudgeSpeed(was, is);
  EXPECT_EQ(judgement.Code(), ExitCode::kSuccess);
  EXPECT_EQ(judgement.speed_not_judged, "");
}

TEST(Judge, FewPairsAreNotJudged) {
  const std::vector<double> five(5, 1.0);
  const Judgement judgement =
      JudgeSpeed(Gated(Record(0.01, 6.0), five), Gated(Record(0.01, 12.0), five));
  EXPECT_EQ(judgement.Code(), ExitCode::kSuccess);
  EXPECT_EQ(judgement.speed_not_judged, "5 repeats; at a confidence of 95 % a change needs 6");
}

TEST(Judge, AccuracyComesBeforeSpeedAndFailuresBeforeBoth) {
  const GatedRun was = Gated(Record(0.01, 6.0));
  const GatedRun bad = Gated(Record(0.02, 12.0));
  EXPECT_EQ(JudgeOf(was, bad).Code(), ExitCode::kAccuracyRegressed);
  const std::string run_id = std::string(kWalk) + ".0123abcd";
  const Judgement failed =
      Judge(BaselineOf(was), {{}, {{run_id, "repeat 1: failed: no pose"}}}, {}, {}, {}, "now0000");
  EXPECT_EQ(failed.Code(), ExitCode::kFailedRun);
  EXPECT_THAT(failed.unmeasured, IsEmpty());  // it is accounted for
}

TEST(Judge, RepeatsThatDifferAreAFailure) {
  const GatedRun was = Gated(Record(0.01, 6.0));
  const GatedRun unsteady =
      MakeGatedRun("nightly", std::vector{Record(0.01, 6.0), Record(0.0100001, 6.0)});
  const Judgement judgement = JudgeOf(was, unsteady);
  EXPECT_EQ(judgement.Code(), ExitCode::kFailedRun);
  EXPECT_THAT(judgement.failures,
              ElementsAre(Pair(kWalk, "not the same in all repeats: l2_mean_m")));
}

TEST(Judge, MeasuringNothingOrLessIsNoSuccess) {
  const GatedRun was = Gated(Record(0.01, 6.0));
  EXPECT_EQ(Judge({}, {}, {}, {}, {}, "now").Code(), ExitCode::kNothingMeasured);
  const Judgement gone = Judge(BaselineOf(was), {}, {}, {}, {}, "now");
  EXPECT_EQ(gone.Code(), ExitCode::kNothingMeasured);
  EXPECT_THAT(gone.unmeasured, ElementsAre(kWalk));
  RunRecord record = Record(0.01, 6.0);
  record.summary.erase("l2_mean_m");
  const Judgement less = JudgeOf(was, Gated(record));
  EXPECT_EQ(less.Code(), ExitCode::kNothingMeasured);
  EXPECT_THAT(less.unmeasured, ElementsAre(std::string(kWalk) + ": l2_mean_m"));
  GatedRun other = was;
  other.scene = "kick";
  const Judgement unknown = Judge(BaselineOf(was), {{was, other}, {}}, {}, {}, {}, "now");
  EXPECT_EQ(unknown.Code(), ExitCode::kSuccess);
  EXPECT_THAT(unknown.unknown, ElementsAre(other.name()));
}

HistoryEntry Entry(const char* commit, double error_m) {
  return {"2026-01-02", commit, "cpu", 0, {Gated(Record(error_m, 6.0))}};
}

TEST(Judge, NamesTheFirstCommitThatCouldBeToBlame) {
  const GatedRun was = Gated(Record(0.01, 6.0));
  const GatedRun is = Gated(Record(0.02, 6.0));
  const auto blame = [&](const std::vector<HistoryEntry>& history) {
    return JudgeOf(was, is, history).Regressions(NumberKind::kAccuracy).at(0)->blame;
  };
  EXPECT_EQ(blame({}).last_good, "base000");
  EXPECT_EQ(blame({}).first_bad, "now0000");
  const Blame later = blame({Entry("aaa", 0.01), Entry("bbb", 0.02), Entry("ccc", 0.01),
                             Entry("ddd", 0.03), Entry("eee", 0.02)});
  EXPECT_EQ(later.last_good, "ccc");
  EXPECT_EQ(later.first_bad, "ddd");
}

GatedRun WithSettings(double error_m, const Json& config) {
  RunRecord record = Record(error_m, 6.0);
  record.config = config;
  return Gated(record);
}

TEST(Judge, BlamesNoCommitWhereTheSettingsDifferAndSaysWhich) {
  const Json before = {{"method", {{"settings", {{"fit", {{"cutoff_m", 0.08}}}}}}}, {"old", 1}};
  const Json now = {{"method", {{"settings", {{"fit", {{"cutoff_m", 0.1}}}}}}}, {"old", 1}};
  const GatedRun was = WithSettings(0.01, before), is = WithSettings(0.02, now);
  EXPECT_THAT(ChangedSettings(was, is), ElementsAre("method.settings.fit.cutoff_m: 0.08 → 0.1"));
  EXPECT_THAT(ChangedSettings(was, was), IsEmpty());
  const Judgement judgement = JudgeOf(was, is);
  ASSERT_EQ(judgement.Regressions(NumberKind::kAccuracy).size(), 1u);
  EXPECT_EQ(judgement.Regressions(NumberKind::kAccuracy)[0]->blame.first_bad, "");
  EXPECT_THAT(judgement.changed_settings.at(kWalk), testing::SizeIs(1));
  const GateOccasion occasion{"Nightly", "2026-01-03",    "now0000",  "cpu",
                              {},        BaselineOf(was), {{is}, {}}, {}};
  EXPECT_THAT(
      ToMarkdown(occasion, judgement),
      AllOf(HasSubstr("none: the settings differ"),
            HasSubstr("## Settings that differ from the baseline's\n\n- `" + std::string(kWalk) +
                      "`: method.settings.fit.cutoff_m: 0.08 → 0.1\n")));
  // A baseline of an older program does not know its settings.
  GatedRun old = was;
  old.settings.clear();
  old.config_hash = "";
  EXPECT_THAT(ChangedSettings(old, is), ElementsAre(HasSubstr("does not hold its settings")));
}

TEST(Judge, AFileInAnotherFolderIsTheSameSetting) {
  const auto config = [](const char* clip) { return Json{{"motion", {{"file", clip}}}}; };
  const GatedRun was = WithSettings(0.01, config("/here/02_01.amc"));
  EXPECT_EQ(was.settings.at("motion.file"), "\"02_01.amc\"");
  EXPECT_THAT(ChangedSettings(was, WithSettings(0.01, config("/there/cmu/02_01.amc"))), IsEmpty());
  EXPECT_THAT(ChangedSettings(was, WithSettings(0.01, config("/here/02_05.amc"))),
              ElementsAre("motion.file: \"02_01.amc\" → \"02_05.amc\""));
}

TEST(Judge, LooksForTheCommitInOccasionsOfTheSameSettingsOnly) {
  const Json config = {{"cutoff_m", 0.08}}, other = {{"cutoff_m", 0.1}};
  const auto entry = [](const char* commit, const GatedRun& run) -> HistoryEntry {
    return {"2026-01-02", commit, "cpu", 0, {run}};
  };
  const std::vector<HistoryEntry> history = {entry("aaa", WithSettings(0.01, config)),
                                             entry("bbb", WithSettings(0.02, other)),
                                             entry("ccc", WithSettings(0.02, config))};
  const Judgement judgement =
      JudgeOf(WithSettings(0.01, config), WithSettings(0.02, config), history);
  const Blame blame = judgement.Regressions(NumberKind::kAccuracy).at(0)->blame;
  EXPECT_EQ(blame.last_good, "aaa");
  EXPECT_EQ(blame.first_bad, "ccc");
}

TEST(GateFiles, OnlyTheBaselineHoldsSettings) {
  const TemporaryFolder folder;
  const GatedRun run = WithSettings(0.01, {{"cutoff_m", 0.08}});
  WriteBaseline(folder / "base.json", BaselineOf(run));
  WriteHistory(folder / "history.json", {{"2026-01-02", "aaa", "cpu", 0, {run}}});
  EXPECT_EQ(ReadBaseline(folder / "base.json").runs.at(0).settings, run.settings);
  const GatedRun then = ReadHistory(folder / "history.json").at(0).runs.at(0);
  EXPECT_THAT(then.settings, IsEmpty());
  EXPECT_EQ(then.config_hash, run.config_hash);
}

TEST(GateFiles, AreReadAsWritten) {
  const TemporaryFolder folder;
  GateBaseline baseline = BaselineOf(Gated(Record(0.01, 6.0)));
  baseline.renewals = {{"2026-01-01", "base000", "the first"}};
  WriteBaseline(folder / "base/nightly.json", baseline);
  const GateBaseline again = ReadBaseline(folder / "base/nightly.json");
  EXPECT_EQ(again.commit, "base000");
  EXPECT_EQ(again.renewals.at(0).reason, "the first");
  ASSERT_NE(FindRun(again.runs, kWalk), nullptr);
  EXPECT_EQ(StoredJson(*FindRun(again.runs, kWalk)), StoredJson(baseline.runs[0]));
  WriteHistory(folder / "history.json", {Entry("aaa", 0.01)});
  EXPECT_EQ(ReadHistory(folder / "history.json").at(0).commit, "aaa");
  EXPECT_THAT(ReadHistory(folder / "none.json"), IsEmpty());
  EXPECT_THROW(ReadBaseline(folder / "none.json"), ConfigError);
  // Until version 1 times were multiples of a kernel's.
  nlohmann::json old = ReadJsonFile(folder / "base/nightly.json");
  old["version"] = 1;
  old["runs"][0].erase("times_ms");
  old["runs"][0]["speed"] = {{kWholeFrame, 0.6}};
  old["runs"][0]["speed_noise"] = {{kWholeFrame, 0.1}};
  old["runs"][0]["calibration_ms"] = 10.0;
  WriteWholeFile(folder / "old.json", old.dump());
  EXPECT_TRUE(ReadBaseline(folder / "old.json").runs.at(0).times_ms.empty());
  EXPECT_EQ(ReadBaseline(folder / "old.json").runs.at(0).accuracy, baseline.runs[0].accuracy);
  WriteWholeFile(folder / "damaged.json", "{\"date\": 3}");
  EXPECT_THAT(
      [&] { ReadBaseline(folder / "damaged.json"); },
      testing::ThrowsMessage<DataError>(HasSubstr("damaged.json: date: expected a text, got 3")));
}

TEST(GateReports, NameRunMetricWasIsToleranceAndBlame) {
  const GateBaseline baseline = BaselineOf(Gated(Record(0.01, 6.0)));
  const MeasuredRuns measured{{Gated(Record(0.02, 12.0))}, {{"nightly: x<y>", "crashed"}}};
  const SpeedReference none{{}, "", "no program"};
  const Judgement judgement = Judge(baseline, measured, none, {}, {Entry("ccc", 0.01)}, "now0000");
  const GateOccasion occasion{"Nightly", "2026-01-03", "now0000", "cpu",
                              {},        baseline,     measured,  none};
  const std::string markdown = ToMarkdown(occasion, judgement);
  EXPECT_THAT(markdown, HasSubstr("| `nightly: default.walk.realtime_scape.s1` | l2_mean_m | 10 mm "
                                  "| 20 | +100.0 % | 10.01 | now0000 (good at ccc) |"));
  EXPECT_THAT(markdown, HasSubstr("# Nightly: failed: 1 run"));
  EXPECT_THAT(markdown, HasSubstr("- `nightly: x<y>`: crashed"));
  EXPECT_THAT(markdown, HasSubstr("Speed not judged: no program."));
  const std::string junit = ToJunit(occasion, judgement);
  EXPECT_THAT(junit, HasSubstr("tests=\"3\" failures=\"1\" errors=\"1\""));
  EXPECT_THAT(junit, HasSubstr("name=\"speed\">\n    <skipped message=\"no program\"/>"));
  EXPECT_THAT(junit, HasSubstr("x&lt;y&gt;"));
  EXPECT_EQ(Count(junit, "<testcase"), 3u);
  EXPECT_EQ(Count(junit, "</testcase>"), 3u);
  const nlohmann::json json = StoredJson(MakeRegressionFile(occasion, judgement));
  EXPECT_EQ(json.at("exit_code"), 4);
  EXPECT_EQ(json.at("findings").size(), 3u);
}

TEST(GateReports, SayByHowMuchATimeChangedAndHowSureThatIs) {
  const GatedRun was = Gated(Record(0.01, 6.0), kSevenTimes);
  const GatedRun is = Gated(WithSlowerRender(1.1), kSevenTimes);
  const SpeedReference reference{{was}, "base000", ""};
  const Judgement judgement = JudgeSpeed(was, is);
  const GateOccasion occasion{"Nightly", "2026-01-03",   "now0000",  "cpu",
                              {},        BaselineOf(is), {{is}, {}}, reference};
  const std::string markdown = ToMarkdown(occasion, judgement);
  EXPECT_THAT(markdown,
              HasSubstr("| 5 render | 3 ms | 3.3 | +10.0 % (+10.0 % … +10.0 %) | 3.15 |"));
  EXPECT_THAT(markdown, HasSubstr("baseline's program (commit `base000`), run in turn"));
}

}  // namespace
}  // namespace vitruvia
