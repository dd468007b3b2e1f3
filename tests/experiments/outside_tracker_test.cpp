// A tracker in another language, run and scored by the same commands as ours.
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.h"
#include "experiments/command_line.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class OutsideTracker : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("python3 --version >/dev/null 2>&1") != 0)
      GTEST_SKIP() << "python3 is not installed";
  }

  void WriteMethod(const std::vector<std::string>& arguments) const {
    files_.Write("method.json",
                 {{"method", "external"},
                  {"settings",
                   {{"program", VITRUVIA_SOURCE_DIR "/tests/methods/outside_tracker.py"},
                    {"arguments", arguments},
                    {"answer_within_s", 20}}}});
  }

  CallResult Run() const {
    return CallVitruvia({"run", files_.File("experiment.json"), "-o", files_.File("out")});
  }

  // Tracks with that fault in frame 2 and expects the run to fail so.
  void ExpectFailure(const std::string& fault, const std::string& words) const {
    WriteMethod({"--fault", fault});
    ExpectRefusal({"track", files_.File("method.json"), "--sequence", files_.File("sequence"), "-o",
                   files_.File("estimate")},
                  ExitCode::kFailedRun, {"outside_tracker.py: " + words});
    EXPECT_FALSE(fs::exists(files_ / "estimate"));
  }

  SmallExperiment files_;
};

TEST_F(OutsideTracker, IsRunScoredAndReportedLikeOurs) {
  WriteMethod({});
  const CallResult call = Run();
  ASSERT_EQ(call.code, 0) << call.error;
  const Json row = ReadJsonFile(files_ / "out/summary.json").at("rows").at(0);
  EXPECT_EQ(row.at("frames"), 12);
  EXPECT_EQ(row.at("frames_failed"), 0);
  EXPECT_LT(row.at("l2_mean_m").get<double>(), 0.15);  // arms begin to move, its own do not
  EXPECT_GT(row.at("l2_mean_m").get<double>(), 0.0);
  EXPECT_TRUE(fs::exists(files_ / "out/report.html"));
}

TEST_F(OutsideTracker, TheTruthAsItsAnswerScoresPerfectly) {
  ASSERT_EQ(CallVitruvia({"synth", files_.File("scene.json"), "-o", files_.File("sequence")}).code,
            0);
  WriteMethod({"--replay", files_.File("sequence")});
  const CallResult call = CallVitruvia({"track", files_.File("method.json"), "--sequence",
                                        files_.File("sequence"), "-o", files_.File("estimate")});
  ASSERT_EQ(call.code, 0) << call.error;
  const Json row = Json::parse(call.out);
  EXPECT_EQ(row.at("l2_max_m"), 0.0);
  EXPECT_EQ(row.at("joint_error_max_m"), 0.0);
}

TEST_F(OutsideTracker, WhatItDoesWrongFailsItsRunWithTheFrame) {
  ASSERT_EQ(CallVitruvia({"synth", files_.File("scene.json"), "-o", files_.File("sequence")}).code,
            0);
  ExpectFailure("end", "has ended with exit code 3 after 0 bytes of an answer");
  ExpectFailure("talk", "frame 2: expected a line with a JSON object, got tracking...");
  ExpectFailure("joints", "frame 2: expected \"joints\": 17 points");
  ExpectFailure("outcome", "frame 2: expected \"outcome\": converged, iteration_limit, lost");
  ExpectFailure("names", "frame 2: expected the energies and steps of the first frame");
  ExpectFailure("numbers", "frame 2: expected finite vertices, vertex 5 is not");
}

// Programs that never become a tracker. The sequence is made once for all of them.
class OutsideProgram : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(
        CallVitruvia({"synth", files_.File("scene.json"), "-o", files_.File("sequence")}).code, 0);
  }

  void WriteProgram(const std::string& name, const std::string& text, fs::perms permissions) const {
    WriteWholeFile(files_ / name, text);
    fs::permissions(files_ / name, permissions);
  }

  void ExpectRefused(const std::string& program, ExitCode code, const std::string& words,
                     double answer_within_s = 20.0) const {
    files_.Write("method.json",
                 {{"method", "external"},
                  {"settings", {{"program", program}, {"answer_within_s", answer_within_s}}}});
    ExpectRefusal({"track", files_.File("method.json"), "--sequence", files_.File("sequence"), "-o",
                   files_.File("estimate")},
                  code, {words});
    EXPECT_FALSE(fs::exists(files_ / "estimate"));
  }

  SmallExperiment files_;
};

TEST_F(OutsideProgram, ThatCannotBeExecutedIsRefusedWithTheReasonOfTheSystem) {
  constexpr ExitCode kCode = ExitCode::kBadConfiguration;
  ExpectRefused("nowhere.sh", kCode, "nowhere.sh: cannot be started: No such file or directory");
  WriteProgram("plain.sh", "#!/bin/sh\n", fs::perms::owner_read);
  ExpectRefused("plain.sh", kCode, "plain.sh: cannot be started: Permission denied");
  fs::create_directory(files_ / "folder");
  ExpectRefused("folder", kCode,
                "folder: cannot be started: Permission denied; expected a file, this is a folder");
  for (const char* text : {"print('no interpreter named')\n", ""}) {
    WriteProgram("no_shebang.py", text, fs::perms::owner_all);
    ExpectRefused("no_shebang.py", kCode,
                  "no_shebang.py: cannot be started: Exec format error; expected a program for "
                  "this machine, or a script whose first line names its interpreter, such as "
                  "\"#!/usr/bin/env python3\"");
  }
  for (const char* text : {"#!/nowhere/python3\n", "#!/bin/sh\r\n"}) {
    WriteProgram("no_interpreter.py", text, fs::perms::owner_all);
    ExpectRefused("no_interpreter.py", kCode,
                  "cannot be started: No such file or directory; the file is there, but not the "
                  "interpreter that it asks for (its #! line)");
  }
}

TEST_F(OutsideProgram, ThatEndsOrHangsFailsItsRun) {
  constexpr ExitCode kCode = ExitCode::kFailedRun;
  WriteProgram("program.sh", "#!/bin/sh\nexec sleep 60\n", fs::perms::owner_all);
  ExpectRefused("program.sh", kCode, "program.sh: no answer within 0.3 s", 0.3);
  WriteProgram("program.sh", "#!/bin/sh\nread start\nkill -SEGV $$\n", fs::perms::owner_all);
  ExpectRefused("program.sh", kCode,
                "program.sh: was ended by signal 11 (Segmentation fault) after 0 bytes");
  WriteProgram("program.sh", "#!/bin/sh\nread start\nprintf ready\nexit 127\n",
               fs::perms::owner_all);
  ExpectRefused("program.sh", kCode, "program.sh: has ended with exit code 127 after 5 bytes");
}

}  // namespace
}  // namespace vitruvia
