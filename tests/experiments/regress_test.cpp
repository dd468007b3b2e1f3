// The regression gate from configs to exit codes. Speed is judged on records that are doctored, not
// on this machine's clock.
#include <fstream>

#include <gmock/gmock.h>

#include "experiments/command_outcome.h"
#include "experiments/tiny_experiment.h"

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

  CommandOutcome Call(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"regress",    files_.File("nightly.json"),
                                      "--baseline", files_.File("base"),
                                      "-o",         files_.File("out")};
    words.insert(words.end(), more.begin(), more.end());
    return CallCommand(words);
  }

  // Measures, and takes that as the baseline.
  void TakeBaseline() const {
    const CommandOutcome outcome = Call({"--update", "--reason", "the first"});
    ASSERT_EQ(outcome.code, ExitCode::kSuccess) << outcome.error;
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

  TinyExperiment files_;
};

TEST_F(Regress, UnchangedNumbersPassAndTheReasonIsKept) {
  TakeBaseline();
  EXPECT_EQ(Call({"--stored"}).code, ExitCode::kSuccess);
  EXPECT_THAT(Report("md"), HasSubstr("# Tiny: ok: "));
  const Json baseline = files_.Read("base/nightly.json");
  EXPECT_EQ(baseline.at("renewals").at(0).at("reason"), "the first");
  const Json run = baseline.at("runs").at(0);
  EXPECT_EQ(run.at("experiment"), "experiment");
  EXPECT_EQ(run.at("repeats"), 2);
  EXPECT_TRUE(run.at("unsteady").empty());
  for (const char* metric : {"l2_mean_m", "l2_max_m", "joint_error_mean_m", "frames_failed"})
    EXPECT_TRUE(run.at("accuracy").contains(metric)) << metric;
  EXPECT_TRUE(run.at("speed").contains("frame"));
  EXPECT_GT(run.at("calibration_ms").get<double>(), 0.0);
  ASSERT_EQ(Call({"--stored", "--update", "--reason", "the second"}).code, ExitCode::kSuccess);
  EXPECT_EQ(files_.Read("base/nightly.json").at("renewals").at(1).at("reason"), "the second");
}

TEST_F(Regress, AChangedWeightOfATermTripsAccuracy) {
  TakeBaseline();
  files_.Write("method.json",
               {{"method", "realtime_scape"}, {"settings", {{"fit", {{"surface_weight", 0.0}}}}}});
  const CommandOutcome outcome = Call({});  // measures anew
  EXPECT_EQ(outcome.code, ExitCode::kAccuracyRegressed) << outcome.out;
  EXPECT_THAT(outcome.error, HasSubstr("vitruvia: regress: accuracy regressed: "));
  EXPECT_THAT(Report("md"), HasSubstr("| `experiment: default.scene.method.s1` | l2_mean_m | "));
  EXPECT_THAT(Report("xml"), HasSubstr("name=\"accuracy\">\n    <failure message=\""));
  const Json history = files_.Read("out/history.json");
  ASSERT_EQ(history.size(), 1u);
  EXPECT_EQ(history.at(0).at("exit_code"), static_cast<int>(ExitCode::kAccuracyRegressed));
}

TEST_F(Regress, AStepSlowedByThirtyPercentTripsSpeed) {
  TakeBaseline();
  Doctor([](Json& record) {
    Json* slowest = &record["steps"][0];
    for (Json& step : record["steps"]) {
      if (step["median_ms"] > (*slowest)["median_ms"]) slowest = &step;
    }
    const double ms = (*slowest)["median_ms"];
    (*slowest)["median_ms"] = 1.3 * ms;
    record["summary"]["frame_ms_median"] =
        record["summary"]["frame_ms_median"].get<double>() + 0.3 * ms;
  });
  const CommandOutcome outcome = Call({"--stored"});
  EXPECT_EQ(outcome.code, ExitCode::kSpeedRegressed) << outcome.out;
  EXPECT_EQ(files_.Read("out/regression.json").at("exit_code"), 6);
}

TEST_F(Regress, AnImprovementIsToldAndPasses) {
  TakeBaseline();
  Doctor([](Json& record) {
    record["summary"]["l2_mean_m"] = 0.5 * record["summary"]["l2_mean_m"].get<double>();
  });
  EXPECT_EQ(Call({"--stored"}).code, ExitCode::kSuccess);
  EXPECT_THAT(Report("md"), HasSubstr("## Improved beyond tolerance"));
}

TEST_F(Regress, ARunThatEndsInAnErrorTripsFailed) {
  TakeBaseline();
  Json scene = files_.Read("scene.json");
  scene["motion"]["file"] = "gone.json";
  files_.Write("scene.json", scene);
  const CommandOutcome outcome = Call({});
  EXPECT_EQ(outcome.code, ExitCode::kFailedRun) << outcome.out;
  EXPECT_THAT(Report("md"), HasSubstr("gone.json"));
  EXPECT_THAT(Report("xml"), HasSubstr("<error message=\"repeat 2: failed: "));
  const CommandOutcome renewal = Call({"--stored", "--update", "--reason", "none"});
  EXPECT_EQ(renewal.code, ExitCode::kFailedRun);
  EXPECT_THAT(renewal.error, HasSubstr("not renewed, since a run failed"));
}

TEST_F(Regress, NothingMeasuredIsNoSuccess) {
  TakeBaseline();
  const CommandOutcome empty = Call({"--only", "nosuch"});
  EXPECT_EQ(empty.code, ExitCode::kNothingMeasured);
  EXPECT_THAT(empty.error, HasSubstr("regress: nothing measured"));
  EXPECT_THAT(Report("xml"), HasSubstr("errors=\"1\""));
  Json baseline = files_.Read("base/nightly.json");
  Json gone = baseline.at("runs").at(0);
  gone["scene"] = "gone";
  baseline["runs"].push_back(gone);
  files_.Write("base/nightly.json", baseline);
  EXPECT_EQ(Call({"--stored"}).code, ExitCode::kNothingMeasured);
  EXPECT_THAT(Report("md"), HasSubstr("- `experiment: default.gone.method.s1`"));
}

TEST_F(Regress, BadInputIsRefusedBeforeAnythingIsMeasured) {
  const auto refused = [&](const std::vector<std::string>& more, ExitCode code,
                           const std::string& words) {
    const CommandOutcome outcome = Call(more);
    EXPECT_EQ(outcome.code, code) << outcome.error;
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
  refused({}, ExitCode::kBadData, "nightly.json: date: key missing");
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
  EXPECT_EQ(Call({"--stored"}).code, ExitCode::kBadData);
}

}  // namespace
}  // namespace vitruvia
