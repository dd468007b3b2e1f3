// The command line from end to end on a dozen small frames: what it writes, and how it refuses.
#include "experiments/command_line.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.h"
#include "experiments/plan/run_plan.h"
#include "scoring/score.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class CommandLine : public testing::Test {
 protected:
  static Json Experiment() { return SmallExperiment::Config(); }
  std::string File(const std::string& name) const { return folder_.File(name); }
  static CallResult Call(const std::vector<std::string>& arguments) {
    return CallVitruvia(arguments);
  }

  // A sequence of the tiny scene, fresh for a test to damage.
  std::string Sequence() const {
    std::string sequence = File("sequence");
    EXPECT_EQ(Call({"synth", File("scene.json"), "-o", sequence}).code, 0);
    return sequence;
  }

  CallResult Track(const std::string& sequence) const {
    return Call({"track", File("method.json"), "--sequence", sequence, "-o", File("estimate")});
  }

  SmallExperiment folder_;
};

void Write(const fs::path& file, const Json& json) { WriteWholeFile(file, json.dump()); }

Json OnlyRecord(const fs::path& experiment_folder) {
  const Json summary = ReadJsonFile(experiment_folder / "summary.json");
  EXPECT_EQ(summary.at("rows").size(), 1u);
  const std::string run = summary.at("rows").at(0).at("run_id");
  return ReadJsonFile(experiment_folder / run / "record.json");
}

TEST_F(CommandLine, RunWritesSummaryRecordAndReportAndSameSeedTwiceIsTheSame) {
  ASSERT_EQ(Call({"run", File("experiment.json"), "-o", File("first")}).code, 0);
  ASSERT_EQ(Call({"run", File("experiment.json"), "-o", File("second")}).code, 0);
  const Json row = ReadJsonFile(folder_ / "first" / "summary.json").at("rows").at(0);
  for (const char* key :
       {"variant", "scene", "seed", "frames", "frames_failed", "l2_mean_m", "l2_mean_of_diagonal",
        "l2_max_of_diagonal", "joint_error_mean_m", "joints_within_10cm", "frame_ms_median",
        "frame_ms_p95", "iterations_mean", "run_id"}) {
    EXPECT_TRUE(row.contains(key)) << key;
  }
  EXPECT_EQ(row.at("frames"), 12);
  EXPECT_EQ(row.at("frames_failed"), 0);
  EXPECT_LT(row.at("l2_mean_m").get<double>(), 0.02);
  EXPECT_TRUE(fs::exists(folder_ / "first" / "report.html"));
  EXPECT_EQ(WithoutClock(OnlyRecord(folder_ / "first")),
            WithoutClock(OnlyRecord(folder_ / "second")));
}

TEST_F(CommandLine, RunKeepsWhatThisBuildHasDone) {
  ASSERT_EQ(Call({"run", File("experiment.json"), "-o", File("out")}).code, 0);
  const Json before = OnlyRecord(folder_ / "out");
  const CallResult again = Call({"run", File("experiment.json"), "-o", File("out")});
  EXPECT_NE(again.out.find("0 runs done, 1 kept, 0 failed"), std::string::npos) << again.out;
  EXPECT_EQ(OnlyRecord(folder_ / "out"), before);
}

TEST_F(CommandLine, GridIsScenesTimesVariantsTimesSeeds) {
  Json experiment = Experiment();
  experiment["variants"] = {{{"name", "paper"}},
                            {{"name", "free"}, {"method", {{"settings", {{"axis_weight", 0}}}}}}};
  experiment["seeds"] = {1, 2, 3};
  Write(folder_ / "grid.json", experiment);
  const ExperimentPlan plan = PlanExperiment(folder_ / "grid.json");
  ASSERT_EQ(plan.runs.size(), 6u);
  EXPECT_EQ(plan.runs[3].variant, "free");
  EXPECT_EQ(plan.runs[3].seed, 1);
  EXPECT_EQ(plan.runs[3].method.settings.at("axis_weight"), 0.0);
  EXPECT_EQ(plan.runs[0].method.settings.at("axis_weight"), 1.0);
}

// A setting of one method is no setting of the other.
TEST_F(CommandLine, VariantsAreTrackedByTheMethodsThatTheyAreAbout) {
  Write(folder_ / "capsules.json", {{"method", "capsule_icp"}});
  Json experiment = Experiment();
  experiment["methods"] = {"method.json", "capsules.json"};
  experiment["variants"] = {
      {{"name", "free"}, {"methods", {"meth*"}}, {"method", {{"settings", {{"axis_weight", 0}}}}}},
      {{"name", "plain"}, {"methods", {"capsules"}}},
      {{"name", "all"}}};
  Write(folder_ / "grid.json", experiment);
  std::vector<std::string> runs;
  for (const RunPlan& run : PlanExperiment(folder_ / "grid.json").runs)
    runs.push_back(run.method_name + "/" + run.variant);
  EXPECT_EQ(runs, (std::vector<std::string>{"method/free", "method/all", "capsules/plain",
                                            "capsules/all"}));
}

TEST_F(CommandLine, ConfigNamesAreTakenBelowConfigs) {
  EXPECT_EQ(ConfigName("/a/configs/realtime_scape/fig11.json"), "realtime_scape/fig11");
  EXPECT_EQ(ConfigName("/a/b/mine.json"), "mine");
}

TEST_F(CommandLine, TruthAsEstimateScoresExactlyZeroAndEverything) {
  const SequenceReader sequence(Sequence());
  EstimateWriter writer(folder_ / "truth", sequence.true_rest_mesh());
  for (int i = 0; i < sequence.info().frames; ++i) {
    TrackResult result;
    result.outcome = Outcome::kConverged;
    result.vertices = sequence.ReadTrueVertices(i);
    result.joints = sequence.true_joints(i).positions;
    result.step_ms = {{"all", 1.0}};
    writer.Append(result, 1.0);
  }
  writer.Finish();
  RunRecord record;
  ScoreRun(sequence, EstimateReader(folder_ / "truth"), ScoreSettings(), record);
  EXPECT_EQ(record.summary.at("l2_mean_m"), 0.0);
  EXPECT_EQ(record.summary.at("l2_max_of_diagonal"), 0.0);
  EXPECT_EQ(record.summary.at("joint_error_mean_m"), 0.0);
  EXPECT_EQ(record.summary.at("joints_within_10cm"), 1.0);
  for (const double share : record.joint_accuracy.at("all")) EXPECT_EQ(share, 1.0);
}

TEST_F(CommandLine, MisuseIsABadConfiguration) {
  ExpectRefusal({}, ExitCode::kBadConfiguration, {"expected a command"});
  ExpectRefusal({"rum"}, ExitCode::kBadConfiguration, {"rum"});
  ExpectRefusal({"synth"}, ExitCode::kBadConfiguration, {"SCENE.json -o DIR"});
  ExpectRefusal({"explain", "axis_wieght"}, ExitCode::kBadConfiguration,
                {"did you mean \"axis_weight\"?"});
  ExpectRefusal({"run", ""}, ExitCode::kBadConfiguration, {"EXPERIMENT: expected a value"});
  ExpectRefusal({"verify", ""}, ExitCode::kBadConfiguration, {"SEQ: expected a value"});
  ExpectRefusal({"import", "depth", "c.json", "-o", ""}, ExitCode::kBadConfiguration,
                {"--output: expected a value"});
  ExpectRefusal({"report", File(""), "--font-size", "nan"}, ExitCode::kBadConfiguration,
                {"--font-size: expected a number in 3 … 40, got nan"});
  ExpectRefusal({"subject", "--space", "s", "-o", "o", "--height", "nan"},
                ExitCode::kBadConfiguration, {"--height: expected a number in 0.6 … 2.5"});
}

TEST_F(CommandLine, BadConfigsAreNamedAndNothingIsWritten) {
  const auto refused = [&](const Json& experiment, const std::vector<std::string>& words) {
    Write(folder_ / "bad.json", experiment);
    ExpectRefusal({"run", File("bad.json"), "-o", File("never")}, ExitCode::kBadConfiguration,
                  words);
    EXPECT_FALSE(fs::exists(folder_ / "never"));
  };
  Json e = Experiment();
  e["sceens"] = Json::array();
  refused(e, {"bad.json: sceens: unknown key", "did you mean \"scenes\"?"});
  e = Experiment();
  e["title"] = 3;
  refused(e, {"bad.json: title: expected a text, got 3"});
  e = Experiment();
  e["scenes"] = {"missing.json"};
  refused(e, {"missing.json: cannot be opened"});
  e = Experiment();
  e["variants"] = {{{"name", "v"}, {"method", {{"settings", {{"joint_weight", -1}}}}}}};
  refused(e, {"method.json: settings.joint_weight: expected a number in 0", "got -1"});
  e = Experiment();
  e["variants"] = {{{"name", "a"}}, {{"name", "a"}}};
  refused(e, {"\"a\" stands twice"});
  e = Experiment();
  const Json mean = {{"name", "m"}, {"series", "l2_mean_m"}, {"statistic", "mean"}};
  e["summaries"] = {mean, mean};
  refused(e, {"summaries: the name \"m\" stands twice"});
  e["summaries"] = {mean};
  e["table_columns"] = {"summary[n]"};
  refused(e, {"table_columns: summary[n]: the experiment defines no summary \"n\""});
  e["table_columns"] = {"summary[m]", "summary[m]"};
  refused(e, {"table_columns: the name \"summary[m]\" stands twice"});
  e = Experiment();
  e["expectations"] = {{{"metric", "l2_mean_m"}, {"at_most", 1}, {"scenes", {"scen"}}}};
  refused(e, {"expectations[0]: the experiment has no scene \"scen\"; did you mean \"scene\"?"});
  e = Experiment();
  e["variants"] = {{{"name", "a"}, {"methods", {"dynamic*"}}}};
  refused(e, {"\"a\" is about no method of the experiment: dynamic*"});
  e["methods"] = {"method.json", "dynamic.json"};
  refused(e, {"no variant is about method"});
  e = Experiment();
  e["variants"] = {{{"name", "../a"}}};
  refused(e, {"expected letters, digits"});
  e = Experiment();
  e["scenes"] = Json::array();
  refused(e, {"expected at least one scene file"});
  e = Experiment();
  e["picture_frames"] = {0, 12};
  refused(e, {"picture_frames: no run has a frame 12", "at most 11"});
  e = Experiment();
  e["variants"] = {{{"name", "v"}, {"scene", {{"view", {{"camera", {{"width", 0}}}}}}}}};
  refused(e, {"view.camera.width: expected a whole number in 1", "got 0"});
  WriteWholeFile(folder_ / "bad.json", "{\"title\": ");
  ExpectRefusal({"run", File("bad.json")}, ExitCode::kBadConfiguration,
                {"bad.json: not valid JSON"});
}

TEST_F(CommandLine, DamagedSequencesAreBadData) {
  const std::string sequence = Sequence();
  EXPECT_EQ(Call({"synth", "--verify", sequence}).code, 0);
  const fs::path png = fs::path(sequence) / "depth" / "000003.png";
  const std::string whole = ReadWholeFile(png);
  WriteWholeFile(png, whole.substr(0, whole.size() / 2));
  ExpectRefusal({"synth", "--verify", sequence}, ExitCode::kBadData, {"000003.png"});
  const CallResult outcome = Track(sequence);
  EXPECT_EQ(outcome.code, static_cast<int>(ExitCode::kBadData)) << outcome.error;
  EXPECT_FALSE(fs::exists(folder_ / "estimate"));  // nothing half-written
  for (const auto& entry : fs::directory_iterator(folder_.path())) {
    EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
  }
}

TEST_F(CommandLine, EmptySequencesImagesWithoutSizeAndTooFewWeightsAreBadData) {
  const std::string sequence = Sequence();
  const fs::path info_file = fs::path(sequence) / "sequence.json";
  const Json info = ReadJsonFile(info_file);
  Json damaged = info;
  damaged["frames"] = 0;
  Write(info_file, damaged);
  EXPECT_EQ(Track(sequence).code, static_cast<int>(ExitCode::kBadData));
  damaged = info;
  damaged["camera"]["width"] = 0;
  Write(info_file, damaged);
  EXPECT_EQ(Track(sequence).code, static_cast<int>(ExitCode::kBadData));
  Write(info_file, info);
  const fs::path weights = fs::path(sequence) / "subject" / "weights.bin";
  WriteWholeFile(weights, ReadWholeFile(weights).substr(320));
  ExpectRefusal({"track", File("method.json"), "--sequence", sequence, "-o", File("estimate")},
                ExitCode::kBadData, {"weights.bin"});
}

TEST_F(CommandLine, JointsWithoutTruthAreNotScoredAndNamed) {
  const std::string sequence = Sequence();
  for (const char* file : {"sequence.json", "truth/joints.json"}) {
    Json json = ReadJsonFile(fs::path(sequence) / file);
    json["joints"][4] = "left_ear";
    Write(fs::path(sequence) / file, json);
  }
  const CallResult outcome = Track(sequence);
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  const Json row = Json::parse(outcome.out);
  EXPECT_EQ(row.at("not_scored"),
            "joints without truth: head; joints that the skeleton has not: left_ear");
  EXPECT_TRUE(row.contains("joint_error_mean_m"));
  EXPECT_TRUE(row.contains("l2_mean_m"));
}

TEST_F(CommandLine, MissingInputsAndUnwritableOutputsAreTold) {
  ExpectRefusal({"track", File("method.json"), "--sequence", File("nowhere"), "-o", File("e")},
                ExitCode::kBadData, {"nowhere"});
  ExpectRefusal({"report", File("nowhere")}, ExitCode::kBadData, {"nowhere"});
  WriteWholeFile(folder_ / "plain_file", "");
  ExpectRefusal({"run", File("experiment.json"), "-o", File("plain_file/out")},
                ExitCode::kFailedRun, {"plain_file"});
  ExpectRefusal({"synth", File("scene.json"), "-o", File("plain_file/out")}, ExitCode::kFailedRun,
                {"plain_file"});
}

TEST_F(CommandLine, ExplainSaysUnitRangeDefaultAndSource) {
  const CallResult outcome = Call({"explain", "realtime_scape.inertia_weight"});
  EXPECT_EQ(outcome.code, 0);
  for (const char* word :
       {"keeps each bone's local rotation", "default: 5 (paper; paper A, eq. 7)", "range:"}) {
    EXPECT_NE(outcome.out.find(word), std::string::npos) << outcome.out;
  }
}

TEST_F(CommandLine, ExplainSaysWhatToPasteIntoASweep) {
  EXPECT_THAT(Call({"explain", "realtime_scape.fit.pair_cutoff_m"}).out,
              HasSubstr("\n  sweep:   method.settings.fit.pair_cutoff_m\n"));
  EXPECT_THAT(Call({"explain", "scene.view.camera.fx"}).out,
              HasSubstr("\n  sweep:   scene.view.camera.fx\n"));
  for (const char* key : {"scene.seed", "scene.view.position_m", "experiment.title"})
    EXPECT_THAT(Call({"explain", key}).out, Not(HasSubstr("sweep:"))) << key;
}

TEST_F(CommandLine, ExplainTakesThePathThatItPrintsForASweep) {
  const CallResult outcome = Call({"explain", "method.settings.fit.pixel_sharing"});
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_THAT(outcome.out, HasSubstr("realtime_scape.fit.pixel_sharing\n"));
}

TEST_F(CommandLine, APathThatExplainNamesCanBeSwept) {
  Json experiment = Experiment();
  experiment["sweep"] = {
      {"axes", {{{"setting", "method.settings.fit.pair_cutoff_m"}, {"values", {0.08}}}}}};
  Write(folder_ / "swept.json", experiment);
  EXPECT_EQ(Call({"run", File("swept.json"), "--dry-run"}).code, 0);
}

TEST_F(CommandLine, ExplainSearchesTheTextOfSettingsAndMetrics) {
  const CallResult found = Call({"explain", "--search", "DISTANCE", "pairs"});
  EXPECT_EQ(found.code, 0);
  EXPECT_THAT(found.out, HasSubstr("realtime_scape.fit.pair_cutoff_m\n"));
  EXPECT_THAT(Call({"explain", "--search", "hidden", "joints"}).out,
              HasSubstr("joint_error_mean_hidden_m\n"));
  ExpectRefusal({"explain", "--search", "wobble"}, ExitCode::kBadConfiguration,
                {"no setting or metric has all of the words wobble"});
  ExpectRefusal({"explain", "wobble"}, ExitCode::kBadConfiguration,
                {"no setting or metric \"wobble\"", "--search looks for words"});
}

TEST_F(CommandLine, ExplainSaysHowAMetricIsComputed) {
  const std::string text = Call({"explain", "l2_mean_hidden_m"}).out;
  for (const char* line : {"  formula: mean_f mean_{v ∉ V_f}", "  over:    the hidden vertices",
                           "  counts:  Visible parts are left out"})
    EXPECT_THAT(text, HasSubstr(line));
  EXPECT_THAT(Call({"explain", "--metrics"}).out, testing::StartsWith("# Metrics\n"));
}

TEST_F(CommandLine, SynthPreviewsASceneWithoutMakingIt) {
  const CallResult preview =
      Call({"synth", File("scene.json"), "--preview", File("look/scene.png")});
  ASSERT_EQ(preview.code, 0) << preview.error;
  EXPECT_THAT(ReadWholeFile(folder_ / "look/scene.png"), testing::StartsWith("\x89PNG"));
  ExpectRefusal({"synth", File("scene.json"), "--preview", File("scene.pgm")},
                ExitCode::kBadConfiguration, {"scene.pgm: expected a name that ends in .png"});
  ExpectRefusal({"synth", File("scene.json")}, ExitCode::kBadConfiguration,
                {"SCENE.json --preview FILE.png"});
}

// Two variants; the second's settings change afterwards.
TEST_F(CommandLine, StatusNamesOldRunsAndPruneRemovesThem) {
  Json experiment = Experiment();
  const auto write = [&](double weight) {
    experiment["variants"] = {
        {{"name", "all"}},
        {{"name", "weak"}, {"method", {{"settings", {{"axis_weight", weight}}}}}}};
    Write(folder_ / "changing.json", experiment);
  };
  write(0.5);
  ASSERT_EQ(Call({"run", File("changing.json"), "-o", File("out")}).code, 0);
  write(0.25);
  ASSERT_EQ(Call({"run", File("changing.json"), "-o", File("out")}).code, 0);
  const auto folders = [&] {
    int count = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / "out"))
      count += fs::exists(entry.path() / "run.json") ? 1 : 0;
    return count;
  };
  ASSERT_EQ(folders(), 3);
  const CallResult told = Call({"status", File("changing.json"), "-o", File("out")});
  EXPECT_THAT(told.out, HasSubstr("\nold      weak."));
  EXPECT_THAT(told.out, HasSubstr("1 old runs, of settings that the experiment no longer has"));
  EXPECT_EQ(folders(), 3);
  const CallResult pruned = Call({"status", File("out"), "--prune"});  // by its folder, too
  EXPECT_THAT(pruned.out, HasSubstr("\nremoved  weak."));
  EXPECT_EQ(folders(), 2);
  EXPECT_THAT(Call({"status", File("out")}).out,
              AllOf(HasSubstr("2 runs, 2 done"), Not(HasSubstr("\nold "))));
}

TEST_F(CommandLine, RunAgainCarriesOutTheChosenRunsThatAreDone) {
  Json experiment = Experiment();
  experiment["seeds"] = {1, 2};
  Write(folder_ / "twice.json", experiment);
  ASSERT_EQ(Call({"run", File("twice.json"), "-o", File("out")}).code, 0);
  const Json before = ResultOf(folder_ / "out");
  const CallResult again =
      Call({"run", File("twice.json"), "-o", File("out"), "--again", "--only", "*.s2.*"});
  EXPECT_THAT(again.out, HasSubstr("1 runs done, 0 kept, 0 failed"));
  EXPECT_EQ(ResultOf(folder_ / "out"), before);
  EXPECT_THAT(Call({"run", File("twice.json"), "-o", File("out")}).out,
              HasSubstr("0 runs done, 2 kept, 0 failed"));
}

// report, compare, status and rescore take both.
TEST_F(CommandLine, AnExperimentIsNamedByItsFileOrItsFolder) {
  Json experiment = Experiment();
  experiment["variants"] = {{{"name", "a"}}, {{"name", "b"}}};
  experiment["variants"][1]["method"]["settings"]["axis_weight"] = 0.5;
  Write(folder_ / "both.json", experiment);
  ASSERT_EQ(Call({"run", File("both.json"), "-o", File("out")}).code, 0);
  for (const std::string command : {"report", "compare", "status", "rescore"}) {
    const CallResult by_folder = Call({command, File("out")});
    EXPECT_EQ(by_folder.code, 0) << command << by_folder.error;
    const bool has_output = command != "compare";  // whose -o is its table's file
    if (!has_output) continue;
    const CallResult by_file = Call({command, File("both.json"), "-o", File("out")});
    EXPECT_EQ(by_file.code, 0) << command << by_file.error;
    EXPECT_EQ(by_file.out, by_folder.out) << command;
  }
  ExpectRefusal({"report", File("experiment.json"), "-o", File("nowhere")},
                ExitCode::kBadConfiguration, {"nothing has been run yet"});
}

}  // namespace
}  // namespace vitruvia
