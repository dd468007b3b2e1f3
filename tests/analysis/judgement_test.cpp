#include "analysis/judgement.h"

#include <gmock/gmock.h>

#include "analysis/gate_reports.h"
#include "core/files.h"
#include "support/count.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

constexpr const char* kWalk = "nightly: default.walk.realtime_scape.s1";
constexpr const char* kRender = "5 render";
constexpr const char* kUpdate = "11 update";

RunRecord Record(double error_m, double frame_ms, double calibration_ms) {
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
  record.provenance = {{"calibration_ms", calibration_ms}};
  return record;
}

GatedRun Gated(const RunRecord& record) { return MakeGatedRun("nightly", std::vector{record}); }

GateBaseline BaselineOf(const GatedRun& run) { return {"2026-01-01", "base000", "cpu", {}, {run}}; }

Judgement JudgeOf(const GatedRun& was, const GatedRun& is,
                  const std::vector<HistoryEntry>& history = {}) {
  return Judge(BaselineOf(was), {{is}, {}}, {}, history, "now0000");
}

TEST(MakeGatedRun, TakesMediansOfCalibratedRatiosOverRepeats) {
  const std::vector repeats = {Record(0.01, 6.0, 10.0), Record(0.01, 50.0, 10.0),
                               Record(0.01, 14.0, 20.0)};
  const GatedRun run = MakeGatedRun("nightly", repeats);
  EXPECT_EQ(run.name(), kWalk);
  EXPECT_EQ(run.repeats, 3);
  EXPECT_DOUBLE_EQ(run.speed.at(kWholeFrame), 0.7);  // of 0.6, 5 and 0.7
  EXPECT_DOUBLE_EQ(run.speed.at(kRender), 0.35);
  EXPECT_EQ(run.calibration_ms, 10.0);
  EXPECT_EQ(run.accuracy.at("l2_mean_m"), 0.01);
  EXPECT_FALSE(run.accuracy.contains("frame_ms_median"));
  EXPECT_THAT(run.unsteady, IsEmpty());
}

TEST(Judge, PassesTheSameNumbersOnAMachineOfAnotherSpeed) {
  const GatedRun was = Gated(Record(0.01, 6.0, 10.0));
  const Judgement judgement = JudgeOf(was, Gated(Record(0.01, 18.0, 30.0)));
  EXPECT_EQ(judgement.Code(), ExitCode::kSuccess);
  // Three accuracies, the frame and the step that takes half of it; the short step is not gated.
  EXPECT_EQ(judgement.findings.size(), 5u);
}

TEST(Judge, AccuracyIsHeldTightly) {
  const GatedRun was = Gated(Record(0.01, 6.0, 10.0));
  EXPECT_EQ(JudgeOf(was, Gated(Record(0.010009, 6.0, 10.0))).Code(), ExitCode::kSuccess);
  const Judgement worse = JudgeOf(was, Gated(Record(0.010011, 6.0, 10.0)));
  EXPECT_EQ(worse.Code(), ExitCode::kAccuracyRegressed);
  const auto regressions = worse.Regressions(NumberKind::kAccuracy);
  ASSERT_EQ(regressions.size(), 1u);
  EXPECT_EQ(regressions[0]->metric, "l2_mean_m");
  EXPECT_EQ(regressions[0]->was, 0.01);
  EXPECT_EQ(regressions[0]->is, 0.010011);
  EXPECT_DOUBLE_EQ(regressions[0]->limit, 0.01001);
}

TEST(Judge, OneFailedFrameMoreAndFewerJointsFoundAreRegressions) {
  const GatedRun was = Gated(Record(0.01, 6.0, 10.0));
  RunRecord record = Record(0.01, 6.0, 10.0);
  record.summary["frames_failed"] = 1;
  EXPECT_EQ(JudgeOf(was, Gated(record)).Code(), ExitCode::kAccuracyRegressed);
  record = Record(0.01, 6.0, 10.0);
  record.summary["joints_within_10cm"] = 0.89;
  EXPECT_EQ(JudgeOf(was, Gated(record)).Code(), ExitCode::kAccuracyRegressed);
  record.summary["joints_within_10cm"] = 0.91;
  const Judgement better = JudgeOf(was, Gated(record));
  EXPECT_EQ(better.Code(), ExitCode::kSuccess);
  ASSERT_EQ(better.OfChange(Change::kImproved).size(), 1u);
  EXPECT_EQ(better.OfChange(Change::kImproved)[0]->metric, "joints_within_10cm");
}

TEST(Judge, AStepSlowedByThirtyPercentIsASpeedRegression) {
  const GatedRun was = Gated(Record(0.01, 6.0, 10.0));
  RunRecord record = Record(0.01, 6.0, 10.0);
  record.steps[0].median_ms *= 1.3;
  record.summary["frame_ms_median"] = 6.0 + 0.3 * 3.0;  // the frame itself stays within tolerance
  const Judgement judgement = JudgeOf(was, Gated(record));
  EXPECT_EQ(judgement.Code(), ExitCode::kSpeedRegressed);
  const auto regressions = judgement.Regressions(NumberKind::kSpeed);
  ASSERT_EQ(regressions.size(), 1u);
  EXPECT_EQ(regressions[0]->metric, kRender);
  // The short step may: it is mostly noise.
  record = Record(0.01, 6.0, 10.0);
  record.steps[1].median_ms *= 1.3;
  EXPECT_EQ(JudgeOf(was, Gated(record)).Code(), ExitCode::kSuccess);
  // Twice as fast is told, and no reason to fail.
  const Judgement faster = JudgeOf(was, Gated(Record(0.01, 3.0, 10.0)));
  EXPECT_EQ(faster.Code(), ExitCode::kSuccess);
  EXPECT_EQ(faster.OfChange(Change::kImproved).size(), 2u);
}

TEST(Judge, NoiseOfTheRepeatsIsAllowedToSpeed) {
  const std::vector noisy = {Record(0.01, 4.0, 10.0), Record(0.01, 6.0, 10.0),
                             Record(0.01, 8.0, 10.0)};
  const GatedRun was = MakeGatedRun("nightly", noisy);
  EXPECT_DOUBLE_EQ(was.speed_noise.at(kWholeFrame), 1.0 / 3.0);
  EXPECT_EQ(JudgeOf(was, Gated(Record(0.01, 7.9, 10.0))).Code(), ExitCode::kSuccess);
  EXPECT_EQ(JudgeOf(was, Gated(Record(0.01, 8.1, 10.0))).Code(), ExitCode::kSpeedRegressed);
  const GatedRun steady = Gated(Record(0.01, 6.0, 10.0));
  EXPECT_EQ(JudgeOf(steady, Gated(Record(0.01, 7.9, 10.0))).Code(), ExitCode::kSpeedRegressed);
}

TEST(Judge, AccuracyComesBeforeSpeedAndFailuresBeforeBoth) {
  const GatedRun was = Gated(Record(0.01, 6.0, 10.0));
  const GatedRun bad = Gated(Record(0.02, 12.0, 10.0));
  EXPECT_EQ(JudgeOf(was, bad).Code(), ExitCode::kAccuracyRegressed);
  const std::string run_id = std::string(kWalk) + ".0123abcd";
  const Judgement failed =
      Judge(BaselineOf(was), {{}, {{run_id, "repeat 1: failed: no pose"}}}, {}, {}, "now0000");
  EXPECT_EQ(failed.Code(), ExitCode::kFailedRun);
  EXPECT_THAT(failed.unmeasured, IsEmpty());  // it is accounted for
}

TEST(Judge, RepeatsThatDifferAreAFailure) {
  const GatedRun was = Gated(Record(0.01, 6.0, 10.0));
  const GatedRun unsteady =
      MakeGatedRun("nightly", std::vector{Record(0.01, 6.0, 10.0), Record(0.0100001, 6.0, 10.0)});
  const Judgement judgement = JudgeOf(was, unsteady);
  EXPECT_EQ(judgement.Code(), ExitCode::kFailedRun);
  EXPECT_THAT(judgement.failures,
              ElementsAre(Pair(kWalk, "not the same in all repeats: l2_mean_m")));
}

TEST(Judge, MeasuringNothingOrLessIsNoSuccess) {
  const GatedRun was = Gated(Record(0.01, 6.0, 10.0));
  EXPECT_EQ(Judge({}, {}, {}, {}, "now").Code(), ExitCode::kNothingMeasured);
  const Judgement gone = Judge(BaselineOf(was), {}, {}, {}, "now");
  EXPECT_EQ(gone.Code(), ExitCode::kNothingMeasured);
  EXPECT_THAT(gone.unmeasured, ElementsAre(kWalk));
  RunRecord record = Record(0.01, 6.0, 10.0);
  record.summary.erase("l2_mean_m");
  const Judgement less = JudgeOf(was, Gated(record));
  EXPECT_EQ(less.Code(), ExitCode::kNothingMeasured);
  EXPECT_THAT(less.unmeasured, ElementsAre(std::string(kWalk) + ": l2_mean_m"));
  GatedRun other = was;
  other.scene = "kick";
  const Judgement unknown = Judge(BaselineOf(was), {{was, other}, {}}, {}, {}, "now");
  EXPECT_EQ(unknown.Code(), ExitCode::kSuccess);
  EXPECT_THAT(unknown.unknown, ElementsAre(other.name()));
}

HistoryEntry Entry(const char* commit, double error_m) {
  return {"2026-01-02", commit, 0, {Gated(Record(error_m, 6.0, 10.0))}};
}

TEST(Judge, NamesTheFirstCommitThatCouldBeToBlame) {
  const GatedRun was = Gated(Record(0.01, 6.0, 10.0));
  const GatedRun is = Gated(Record(0.02, 6.0, 10.0));
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

TEST(GateFiles, AreReadAsWritten) {
  const TemporaryFolder folder;
  GateBaseline baseline = BaselineOf(Gated(Record(0.01, 6.0, 10.0)));
  baseline.renewals = {{"2026-01-01", "base000", "the first"}};
  WriteBaseline(folder / "base/nightly.json", baseline);
  const GateBaseline again = ReadBaseline(folder / "base/nightly.json");
  EXPECT_EQ(again.commit, "base000");
  EXPECT_EQ(again.renewals.at(0).reason, "the first");
  ASSERT_NE(again.Find(kWalk), nullptr);
  EXPECT_EQ(StoredJson(*again.Find(kWalk)), StoredJson(baseline.runs[0]));
  WriteHistory(folder / "history.json", {Entry("aaa", 0.01)});
  EXPECT_EQ(ReadHistory(folder / "history.json").at(0).commit, "aaa");
  EXPECT_THAT(ReadHistory(folder / "none.json"), IsEmpty());
  EXPECT_THROW(ReadBaseline(folder / "none.json"), ConfigError);
  WriteWholeFile(folder / "damaged.json", "{\"date\": 3}");
  EXPECT_THAT(
      [&] { ReadBaseline(folder / "damaged.json"); },
      testing::ThrowsMessage<DataError>(HasSubstr("damaged.json: date: expected a text, got 3")));
}

TEST(GateReports, NameRunMetricWasIsToleranceAndBlame) {
  const GateBaseline baseline = BaselineOf(Gated(Record(0.01, 6.0, 10.0)));
  const MeasuredRuns measured{{Gated(Record(0.02, 12.0, 10.0))}, {{"nightly: x<y>", "crashed"}}};
  const Judgement judgement = Judge(baseline, measured, {}, {Entry("ccc", 0.01)}, "now0000");
  const GateOccasion occasion{"Nightly", "2026-01-03", "now0000", "cpu", {}, baseline, measured};
  const std::string markdown = ToMarkdown(occasion, judgement);
  EXPECT_THAT(markdown, HasSubstr("| `nightly: default.walk.realtime_scape.s1` | l2_mean_m | 10 mm "
                                  "| 20 | +100.0 % | 10.01 | now0000 (good at ccc) |"));
  EXPECT_THAT(markdown, HasSubstr("# Nightly: failed: 1 run"));
  EXPECT_THAT(markdown, HasSubstr("- `nightly: x<y>`: crashed"));
  const std::string junit = ToJunit(occasion, judgement);
  EXPECT_THAT(junit, HasSubstr("tests=\"3\" failures=\"2\" errors=\"1\""));
  EXPECT_THAT(junit, HasSubstr("x&lt;y&gt;"));
  EXPECT_EQ(Count(junit, "<testcase"), 3u);
  EXPECT_EQ(Count(junit, "</testcase>"), 3u);
  const nlohmann::json json = StoredJson(MakeRegressionFile(occasion, judgement));
  EXPECT_EQ(json.at("exit_code"), 4);
  EXPECT_EQ(json.at("findings").size(), 5u);
}

}  // namespace
}  // namespace vitruvia
