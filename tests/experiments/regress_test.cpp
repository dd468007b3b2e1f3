// The regression gate from configs to exit codes. Speed is judged on records that are made up, not
// on this machine's clock.
#include <fstream>

#include <gmock/gmock.h>

#include "core/files.h"
#include "experiments/command_line.h"

namespace vitruvia {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

class Regress : public testing::Test {
 protected:
  Regress() {
    files_.Write("nightly.json",
                 {{"title", "Tiny"},
                  {"experiments", {{{"experiment", "experiment.json"}, {"repeats", 2}}}}});
  }

  CallResult Call(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"regress",    files_.File("nightly.json"),
                                      "--baseline", files_.File("base"),
                                      "-o",         files_.File("out")};
    words.insert(words.end(), more.begin(), more.end());
    return CallVitruvia(words);
  }

  // Measures, and takes that as the baseline.
  void TakeBaseline() const {
    const CallResult outcome = Call({"--update", "--reason", "the first"});
    ASSERT_EQ(outcome.code, static_cast<int>(ExitCode::kSuccess)) << outcome.error;
  }

  // Changes the stored record of every repeat.
  void Doctor(void (*change)(Json& record)) const {
    for (const auto& entry : fs::recursive_directory_iterator(files_.File("out"))) {
      if (entry.path().filename() != "record.json") continue;
      Json record = ReadJsonFile(entry.path());
      change(record);
      WriteWholeFile(entry.path(), record.dump());
    }
  }

  std::string Report(const std::string& ending) const {
    return ReadWholeFile(files_.File("out/regression." + ending));
  }

  SmallExperiment files_;
};

TEST_F(Regress, UnchangedNumbersPassAndTheReasonIsKept) {
  TakeBaseline();
  EXPECT_EQ(Call({"--stored"}).code, static_cast<int>(ExitCode::kSuccess));
  EXPECT_THAT(Report("md"), HasSubstr("# Tiny: ok: "));
  const Json baseline = ReadJsonFile(files_ / "base/nightly.json");
  EXPECT_EQ(baseline.at("renewals").at(0).at("reason"), "the first");
  const Json run = baseline.at("runs").at(0);
  EXPECT_EQ(run.at("experiment"), "experiment");
  EXPECT_EQ(run.at("repeats"), 2);
  EXPECT_TRUE(run.at("unsteady").empty());
  for (const char* metric : {"l2_mean_m", "l2_max_m", "joint_error_mean_m", "frames_failed"})
    EXPECT_TRUE(run.at("accuracy").contains(metric)) << metric;
  EXPECT_EQ(run.at("times_ms").at("frame").size(), 2u);
  ASSERT_EQ(Call({"--stored", "--update", "--reason", "the second"}).code,
            static_cast<int>(ExitCode::kSuccess));
  EXPECT_EQ(ReadJsonFile(files_ / "base/nightly.json").at("renewals").at(1).at("reason"),
            "the second");
}

TEST_F(Regress, AChangedWeightOfATermTripsAccuracy) {
  TakeBaseline();
  files_.Write("method.json",
               {{"method", "realtime_scape"}, {"settings", {{"fit", {{"surface_weight", 0.0}}}}}});
  const CallResult outcome = Call({});  // measures anew
  EXPECT_EQ(outcome.code, static_cast<int>(ExitCode::kAccuracyRegressed)) << outcome.out;
  EXPECT_THAT(outcome.error, HasSubstr("vitruvia: regress: accuracy regressed: "));
  EXPECT_THAT(Report("md"), HasSubstr("| `experiment: default.scene.method.s1` | l2_mean_m | "));
  EXPECT_THAT(Report("xml"), HasSubstr("name=\"accuracy\">\n    <failure message=\""));
  const Json history = ReadJsonFile(files_ / "out/history.json").at("entries");
  ASSERT_EQ(history.size(), 1u);
  EXPECT_EQ(history.at(0).at("exit_code"), static_cast<int>(ExitCode::kAccuracyRegressed));
}

// The repeats of this program and of the baseline's that a sitting would have left: all the same
// but for a step that is slower by `factor`.
void MakePairs(const SmallExperiment& files, int repeats, double factor) {
  const auto write = [](const fs::path& from, const fs::path& to, double step_ms) {
    if (from != to) fs::copy(from, to, fs::copy_options::recursive);
    for (const auto& entry : fs::recursive_directory_iterator(to)) {
      if (entry.path().filename() != "record.json") continue;
      Json record = ReadJsonFile(entry.path());
      record["summary"]["frame_ms_median"] = 5.0;
      for (Json& step : record["steps"]) step["median_ms"] = 0.7;
      record["steps"][2]["median_ms"] = step_ms;
      WriteWholeFile(entry.path(), record.dump());
    }
  };
  fs::remove_all(files.File("out/repeat-2"));
  fs::create_directories(files.File("out/baseline"));
  for (int repeat = 1; repeat <= repeats; ++repeat) {
    const std::string name = "repeat-" + std::to_string(repeat);
    write(files / "out/repeat-1", files / "out/baseline" / name, 0.7);
  }
  for (int repeat = 1; repeat <= repeats; ++repeat) {
    const std::string name = "repeat-" + std::to_string(repeat);
    write(files / "out/repeat-1", files / "out" / name, factor * 0.7);
  }
  files.Write("nightly.json",
              {{"title", "Tiny"},
               {"experiments", {{{"experiment", "experiment.json"}, {"repeats", repeats}}}}});
}

TEST_F(Regress, AStepSlowedByTenPercentTripsSpeed) {
  TakeBaseline();
  EXPECT_EQ(Call({"--stored"}).code, 0);
  EXPECT_THAT(Report("md"), HasSubstr("Speed not judged: no program of the baseline"));
  MakePairs(files_, 6, 1.0);
  EXPECT_EQ(Call({"--stored"}).code, 0);
  EXPECT_THAT(Report("md"), HasSubstr("run in turn on this machine"));
  fs::remove_all(files_.File("out/baseline"));
  for (int repeat = 2; repeat <= 6; ++repeat)
    fs::remove_all(files_.File("out/repeat-" + std::to_string(repeat)));
  MakePairs(files_, 6, 1.1);
  const CallResult outcome = Call({"--stored"});
  EXPECT_EQ(outcome.code, static_cast<int>(ExitCode::kSpeedRegressed)) << outcome.out;
  EXPECT_EQ(ReadJsonFile(files_ / "out/regression.json").at("exit_code"), 6);
}

TEST_F(Regress, TheBaselinesProgramRunsInTurn) {
  TakeBaseline();
  const CallResult outcome = Call({"--baseline-program", VITRUVIA_PROGRAM});
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_TRUE(fs::exists(files_ / "out/baseline/repeat-2/experiment/experiment.json"));
  EXPECT_THAT(Report("md"), HasSubstr("Speed not judged: 2 repeats; at a confidence of 95 %"));
  // What goes wrong there is told, and accuracy is judged all the same.
  WriteWholeFile(files_ / "broken.sh", "#!/bin/sh\nexit 3\n");
  fs::permissions(files_ / "broken.sh", fs::perms::owner_all);
  EXPECT_EQ(Call({"--baseline-program", files_.File("broken.sh")}).code, 0);
  EXPECT_THAT(Report("md"),
              HasSubstr("Speed not judged: the baseline's program left nothing readable"));
  const CallResult refused = Call({"--baseline-program", files_.File("none")});
  EXPECT_EQ(refused.code, static_cast<int>(ExitCode::kBadConfiguration));
  EXPECT_THAT(refused.error, HasSubstr("none: No such file or directory; expected a program"));
}

TEST_F(Regress, AnImprovementIsToldAndPasses) {
  TakeBaseline();
  Doctor([](Json& record) {
    record["summary"]["l2_mean_m"] = 0.5 * record["summary"]["l2_mean_m"].get<double>();
  });
  EXPECT_EQ(Call({"--stored"}).code, static_cast<int>(ExitCode::kSuccess));
  EXPECT_THAT(Report("md"), HasSubstr("## Improved beyond tolerance"));
}

TEST_F(Regress, ARunThatEndsInAnErrorTripsFailed) {
  TakeBaseline();
  Json scene = ReadJsonFile(files_ / "scene.json");
  scene["motion"]["file"] = "gone.json";
  files_.Write("scene.json", scene);
  const CallResult outcome = Call({});
  EXPECT_EQ(outcome.code, static_cast<int>(ExitCode::kFailedRun)) << outcome.out;
  EXPECT_THAT(Report("md"), HasSubstr("gone.json"));
  EXPECT_THAT(Report("xml"), HasSubstr("<error message=\"repeat 2: failed: "));
  const CallResult renewal = Call({"--stored", "--update", "--reason", "none"});
  EXPECT_EQ(renewal.code, static_cast<int>(ExitCode::kFailedRun));
  EXPECT_THAT(renewal.error, HasSubstr("not renewed, since a run failed"));
}

TEST_F(Regress, ARunThatCrashesTripsFailed) {
  TakeBaseline();
  WriteWholeFile(files_ / "crash.sh", "#!/bin/sh\nkill -s KILL $PPID\n");  // its caller: the run
  fs::permissions(files_ / "crash.sh", fs::perms::owner_all);
  files_.Write("method.json", {{"method", "external"}, {"settings", {{"program", "crash.sh"}}}});
  const CallResult outcome = Call({});
  EXPECT_EQ(outcome.code, static_cast<int>(ExitCode::kFailedRun)) << outcome.out;
  EXPECT_THAT(outcome.error, HasSubstr("ended by signal 9 (Killed)"));
  EXPECT_THAT(Report("md"), HasSubstr("ended by signal 9"));
  EXPECT_THAT(Report("xml"), HasSubstr("<error message=\"repeat 2: failed: ended by signal 9"));
  EXPECT_EQ(ReadJsonFile(files_ / "out/regression.json").at("exit_code"), 4);
}

TEST_F(Regress, NothingMeasuredIsNoSuccess) {
  TakeBaseline();
  const CallResult empty = Call({"--only", "nosuch"});
  EXPECT_EQ(empty.code, static_cast<int>(ExitCode::kBadConfiguration));
  EXPECT_THAT(empty.error, HasSubstr("no experiment whose name contains \"nosuch\""));
  Json baseline = ReadJsonFile(files_ / "base/nightly.json");
  Json gone = baseline.at("runs").at(0);
  gone["scene"] = "gone";
  baseline["runs"].push_back(gone);
  files_.Write("base/nightly.json", baseline);
  EXPECT_EQ(Call({"--stored"}).code, static_cast<int>(ExitCode::kNothingMeasured));
  EXPECT_THAT(Report("md"), HasSubstr("- `experiment: default.gone.method.s1`"));
}

TEST_F(Regress, BadInputIsRefusedBeforeAnythingIsMeasured) {
  const auto refused = [&](const std::vector<std::string>& more, ExitCode code,
                           const std::string& words) {
    const CallResult outcome = Call(more);
    EXPECT_EQ(outcome.code, static_cast<int>(code)) << outcome.error;
    EXPECT_THAT(outcome.error, HasSubstr(words));
    EXPECT_FALSE(fs::exists(files_.File("out")));
  };
  refused({}, ExitCode::kBadConfiguration,
          "base/nightly.json: there is no baseline; --update --reason TEXT takes one");
  refused({"--update"}, ExitCode::kBadConfiguration, "--update needs --reason TEXT");
  refused({"--reason", "x"}, ExitCode::kBadConfiguration, "expected --update too");
  refused({"--update", "--reason", "x", "--only", "y"}, ExitCode::kBadConfiguration,
          "--only cannot go with it");
  MakeFolder(files_.File("base"));
  WriteWholeFile(files_.File("base/nightly.json"), "{}");
  refused({}, ExitCode::kBadData,
          "nightly.json: date: missing; expected: date of the last renewal");
  files_.Write("nightly.json", {{"title", "Tiny"}, {"experiment", "experiment.json"}});
  refused({}, ExitCode::kBadConfiguration,
          "nightly.json: experiment: unknown key (value \"experiment.json\"); did you mean "
          "\"experiments\"?");
  files_.Write("nightly.json",
               {{"title", "Tiny"}, {"experiments", {{{"experiment", "e.json"}, {"repeats", 0}}}}});
  refused({}, ExitCode::kBadConfiguration,
          "experiments[0].repeats: expected a whole number in 1 … 100, got 0");
}

TEST_F(Regress, StoredNumbersThatAreNotThereAreBadData) {
  TakeBaseline();
  fs::remove_all(files_.File("out/repeat-2"));
  EXPECT_EQ(Call({"--stored"}).code, static_cast<int>(ExitCode::kBadData));
}

// Before anything is measured.
TEST_F(Regress, RunsThatTheBaselineHoldsAndTheExperimentLacksAreTold) {
  TakeBaseline();
  Json experiment = ReadJsonFile(files_ / "experiment.json");
  experiment["seeds"] = {7};
  files_.Write("experiment.json", experiment);
  fs::remove_all(files_ / "out");
  const CallResult outcome = Call({});
  EXPECT_EQ(outcome.code, static_cast<int>(ExitCode::kNothingMeasured)) << outcome.out;
  EXPECT_THAT(outcome.error, HasSubstr("holds runs that the experiments do not have"));
  EXPECT_THAT(outcome.error, HasSubstr(".s1"));
  EXPECT_FALSE(fs::exists(files_ / "out"));
}

TEST_F(Regress, DataThatAreNotThereAreTold) {
  Json scene = ReadJsonFile(files_ / "scene.json");
  scene["body"] = {{"source", "makehuman"}, {"makehuman_folder", "nowhere"}};
  files_.Write("scene.json", scene);
  const CallResult outcome = Call({"--update", "--reason", "first"});
  EXPECT_EQ(outcome.code, static_cast<int>(ExitCode::kBadConfiguration)) << outcome.error;
  EXPECT_THAT(outcome.error, HasSubstr("nowhere"));
  EXPECT_FALSE(fs::exists(files_ / "out"));
}

TEST_F(Regress, ABaselineProgramThatMayNotBeExecutedIsTold) {
  WriteWholeFile(files_ / "program", "#!/bin/sh\n");
  TakeBaseline();
  const CallResult outcome = Call({"--baseline-program", files_.File("program")});
  EXPECT_EQ(outcome.code, static_cast<int>(ExitCode::kBadConfiguration));
  EXPECT_THAT(outcome.error, HasSubstr("make it executable: chmod +x " + files_.File("program")));
}

}  // namespace
}  // namespace vitruvia
