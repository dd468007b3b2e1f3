// What the system round the program may do to it: other folders, other processors, damaged output.
#include <cstdlib>
#include <sys/wait.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.h"
#include "experiments/command_line.h"
#include "experiments/plan/run_plan.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

// As README documents them for scripts.
constexpr int kTooManyFailedFrames = 8, kOtherProcessor = 9;

class Surroundings : public testing::Test {
 protected:
  // By a shell, with variables set before the program's name. Returns its exit code.
  int Shell(const std::string& variables, const std::string& arguments) const {
    const std::string line = fmt::format("{} {} {} >{} 2>{}", variables, VITRUVIA_PROGRAM,
                                         arguments, files_.File("said"), files_.File("messages"));
    return WEXITSTATUS(std::system(line.c_str()));
  }
  std::string Messages() const { return ReadWholeFile(files_ / "messages"); }

  // Two variants; of `damaged` the depth images of the last of its 12 frames hold nothing.
  void WriteDamagedExperiment(int damaged_frames, double limit) const {
    Json config = SmallExperiment::Config();
    config["failed_frames_limit"] = limit;
    config["variants"] = {{{"name", "whole"}},
                          {{"name", "damaged"},
                           {"faults",
                            {{"depth",
                              {{"kind", "zero"},
                               {"first_frame", 12 - damaged_frames},
                               {"frames", damaged_frames}}}}}}};
    files_.Write("experiment.json", config);
  }
  CallResult Run() const {
    return CallVitruvia({"run", files_.File("experiment.json"), "-o", files_.File("out")});
  }
  CallResult Status() const { return CallVitruvia({"status", files_.File("out")}); }

  SmallExperiment files_;
};

TEST_F(Surroundings, ALockFolderThatIsNotThereIsNamedAndNothingIsWritten) {
  const int code = Shell("VITRUVIA_LOCK_DIR=/nonexistent",
                         "run " + files_.File("experiment.json") + " -o " + files_.File("out"));
  EXPECT_EQ(code, static_cast<int>(ExitCode::kFailedRun));
  EXPECT_THAT(Messages(), HasSubstr("/nonexistent/vitruvia-runs.lock: cannot be locked: No such"));
  EXPECT_THAT(Messages(), HasSubstr("set VITRUVIA_LOCK_DIR to a folder"));
  EXPECT_FALSE(fs::exists(files_ / "out"));
}

TEST_F(Surroundings, TmpdirThatIsNotThereMattersOnlyWhereItIsUsed) {
  const std::string variables =
      "TMPDIR=/nonexistent HOME=/nonexistent VITRUVIA_LOCK_DIR=" + files_.path().string();
  EXPECT_EQ(Shell(variables, "run " + files_.File("experiment.json") + " -o " + files_.File("out")),
            0)
      << Messages();
}

TEST_F(Surroundings, AVariableOfAConfigThatNamesNothingIsNamed) {
  Json config = SmallExperiment::Config();
  config["scenes"] = {"$HOME/scene.json"};
  files_.Write("home.json", config);
  EXPECT_EQ(
      Shell("HOME=/nonexistent", "run " + files_.File("home.json") + " -o " + files_.File("out")),
      static_cast<int>(ExitCode::kBadConfiguration));
  EXPECT_THAT(Messages(), HasSubstr("environment variable HOME, which names /nonexistent"));
  EXPECT_FALSE(fs::exists(files_ / "out"));
}

TEST_F(Surroundings, AProcessorWithoutTheInstructionsIsTold) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer's memory does not fit into the emulator";
#endif
  if (std::system("qemu-x86_64 --version >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "qemu-x86_64 is not installed (Debian: qemu-user)";
  const std::string line =
      fmt::format("qemu-x86_64 -cpu Nehalem {} list >{} 2>{}", VITRUVIA_PROGRAM,
                  files_.File("said"), files_.File("messages"));
  EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), kOtherProcessor);
  EXPECT_THAT(Messages(), HasSubstr("this processor lacks instructions of x86-64-v3"));
  EXPECT_EQ(ReadWholeFile(files_ / "said"), "");
}

TEST_F(Surroundings, TwoExperimentsOfOneNameDoNotReplaceEachOthersOutput) {
  MakeFolder(files_ / "b");
  fs::copy_file(files_ / "scene.json", files_ / "b" / "scene.json");
  fs::copy_file(files_ / "method.json", files_ / "b" / "method.json");
  fs::copy_file(files_ / "experiment.json", files_ / "b" / "experiment.json");
  ASSERT_EQ(Run().code, 0);
  const std::string summary = ReadWholeFile(files_ / "out/summary.json");
  for (const char* command : {"run", "status", "submit"}) {
    ExpectRefusal({command, files_.File("b/experiment.json"), "-o", files_.File("out")},
                  ExitCode::kBadConfiguration,
                  {files_.File("out") + ": holds the output of another experiment file, " +
                       files_.File("experiment.json"),
                   "name one with -o"});
  }
  EXPECT_EQ(ReadWholeFile(files_ / "out/summary.json"), summary);
  // Moved or renamed it is still the same experiment.
  fs::rename(files_ / "experiment.json", files_ / "renamed.json");
  EXPECT_EQ(CallVitruvia({"run", files_.File("b/experiment.json"), "-o", files_.File("out")}).code,
            0);
}

TEST_F(Surroundings, ACutRecordIsFoundNamedAndMadeAgain) {
  WriteDamagedExperiment(2, 1.0);
  ASSERT_EQ(Run().code, 0);
  const Json rows = ReadJsonFile(files_ / "out/summary.json").at("rows");
  const std::string cut = rows.at(0).at("run_id"), whole = rows.at(1).at("run_id");
  const fs::path file = files_ / "out" / cut / "record.json";
  const std::string text = ReadWholeFile(file);
  WriteWholeFile(file, text.substr(0, text.size() / 2));

  EXPECT_THAT(Status().out, HasSubstr("damaged  " + cut + ": "));
  const CallResult rescored = CallVitruvia({"rescore", files_.File("out")});
  EXPECT_EQ(rescored.code, static_cast<int>(ExitCode::kBadData));
  EXPECT_THAT(rescored.error, HasSubstr(cut + ": skipped: " + file.string()));
  EXPECT_THAT(rescored.out, HasSubstr(whole + ": the same"));
  const CallResult report = CallVitruvia({"report", files_.File("out")});
  EXPECT_EQ(report.code, 0) << report.error;
  EXPECT_THAT(report.error, HasSubstr(cut + ": left out: damaged: " + file.string()));
  EXPECT_THAT(ReadWholeFile(files_ / "out/report.html"), HasSubstr("damaged: "));
  const CallResult again = Run();
  EXPECT_EQ(again.code, 0) << again.error;
  EXPECT_THAT(again.out, HasSubstr("1 runs done, 1 kept, 0 failed"));
  EXPECT_THAT(Status().out, HasSubstr("2 runs, 2 done"));
}

TEST_F(Surroundings, TooManyFailedFramesAreToldInALineAndByTheExitCode) {
  WriteDamagedExperiment(8, 0.5);
  const CallResult run = Run();
  EXPECT_EQ(run.code, kTooManyFailedFrames) << run.error;
  EXPECT_THAT(run.error, HasSubstr("8 of 12 frames failed, more than the limit of 50 %"));
  EXPECT_THAT(run.error, HasSubstr("too many frames failed in 1 of 2 runs"));
  EXPECT_TRUE(fs::exists(files_ / "out/report.html"));
  const CallResult status = Status();
  EXPECT_EQ(status.code, kTooManyFailedFrames);
  EXPECT_THAT(status.out, HasSubstr(": 8 of 12 frames failed, more than the limit of 50 %\n"));
  WriteDamagedExperiment(8, 0.7);  // no other result: nothing is carried out again
  const CallResult allowed = Run();
  EXPECT_EQ(allowed.code, 0) << allowed.error;
  EXPECT_THAT(allowed.out, HasSubstr("0 runs done, 2 kept"));
  EXPECT_EQ(Status().code, 0);
}

TEST_F(Surroundings, ARunWhoseFramesAllFailedIsAFailedRun) {
  WriteDamagedExperiment(12, 1.0);
  const CallResult run = Run();
  EXPECT_EQ(run.code, static_cast<int>(ExitCode::kFailedRun));
  EXPECT_THAT(run.error, HasSubstr("all of its 12 frames failed"));
  EXPECT_EQ(Status().code, static_cast<int>(ExitCode::kFailedRun));
  EXPECT_THAT(Status().out, HasSubstr("2 runs, 1 done, 1 failed"));
}

TEST_F(Surroundings, NullInAVariantIsRefusedAsInAScene) {
  Json scene = ReadJsonFile(files_ / "scene.json");
  scene["fps"] = nullptr;
  files_.Write("null.json", scene);
  ExpectRefusal({"synth", files_.File("null.json"), "-o", files_.File("out")},
                ExitCode::kBadConfiguration, {"null.json: fps: expected a number", "got null"});
  Json config = SmallExperiment::Config();
  config["variants"] = {{{"name", "v"}, {"scene", {{"view", {{"camera", {{"fx", nullptr}}}}}}}}};
  files_.Write("experiment.json", config);
  ExpectRefusal({"run", files_.File("experiment.json"), "-o", files_.File("out")},
                ExitCode::kBadConfiguration,
                {"variants[0]: scene.view.camera.fx: expected a value, got null"});
  EXPECT_FALSE(fs::exists(files_ / "out"));
}

TEST_F(Surroundings, OutputAndMessagesInOneFileKeepTheirLinesAndOrder) {
  const std::string line = fmt::format(
      "VITRUVIA_LOCK_DIR={} {} run {} -o {} >{} 2>&1", files_.path().string(), VITRUVIA_PROGRAM,
      files_.File("experiment.json"), files_.File("out"), files_.File("log"));
  ASSERT_EQ(WEXITSTATUS(std::system(line.c_str())), 0);
  const std::string log = ReadWholeFile(files_ / "log");
  EXPECT_THAT(log, HasSubstr("\n1 runs done, 0 kept, 0 failed\n"));
  EXPECT_LT(log.find("\nrun "), log.find("\n1 runs done"));        // the table's head
  EXPECT_LT(log.find("\n1 runs done"), log.find("\npictures: "));  // drawing's progress
}

// Every run of every experiment of the project, told to another process and read there, has the
// settings that it was planned with.
TEST(RunPlans, ComeBackAsTheyWereFromTheStoredForm) {
  setenv("VITRUVIA_DATA", VITRUVIA_SOURCE_DIR, 0);
  int runs = 0;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(VITRUVIA_SOURCE_DIR) / "configs")) {
    if (entry.path().extension() != ".json") continue;
    const Json json = ReadJsonFile(entry.path());
    if (!json.contains("methods") || !json.contains("scenes")) continue;
    const ExperimentPlan plan = PlanExperiment(entry.path());
    for (const PlannedRun& planned : PlannedRuns(plan, {"s", "l"})) {
      const Json stored = Json::parse(StoredJson(planned).dump());
      const RunPlan read = ReadRunPlan(FromStoredJson<PlannedRun>(stored, {"run.json", ""}));
      const Json& resolved = planned.resolved;
      if (read.sequence.empty()) {
        EXPECT_EQ(WriteSettings(read.scene_settings), resolved.at("scene")) << entry.path();
      }
      EXPECT_EQ(read.method.settings, resolved.at("method").at("settings")) << entry.path();
      EXPECT_EQ(WriteSettings(read.score), resolved.at("score")) << entry.path();
      if (read.subject) {
        EXPECT_EQ(ResolvedRecipe(*read.subject), resolved.at("subject"));
      }
      EXPECT_EQ(read.faults.AreNone(), !resolved.contains("faults")) << entry.path();
      EXPECT_EQ(CacheKey(read.resolved), planned.key) << entry.path();
      ++runs;
    }
  }
  EXPECT_GT(runs, 100);
}

}  // namespace
}  // namespace vitruvia
