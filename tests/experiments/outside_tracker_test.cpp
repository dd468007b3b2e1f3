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
  ExpectFailure("end", "has ended; 0 bytes of an answer were there");
  ExpectFailure("talk", "frame 2: expected a line with a JSON object, got tracking...");
  ExpectFailure("joints", "frame 2: expected \"joints\": 17 points");
  ExpectFailure("outcome", "frame 2: expected \"outcome\": converged, iteration_limit, lost");
  ExpectFailure("names", "frame 2: expected the energies and steps of the first frame");
  ExpectFailure("numbers", "frame 2: expected finite vertices, vertex 5 is not");
}

TEST_F(OutsideTracker, AProgramThatHangsOrIsNoneIsTold) {
  Json method = {{"method", "external"}, {"settings", {{"program", "hang.sh"}}}};
  method["settings"]["answer_within_s"] = 0.3;
  files_.Write("method.json", method);
  WriteWholeFile(files_ / "hang.sh", "#!/bin/sh\nexec sleep 60\n");
  const auto run_fails = [this](const std::string& words) {
    const CallResult call = Run();
    EXPECT_EQ(call.code, static_cast<int>(ExitCode::kFailedRun));
    EXPECT_THAT(call.error, HasSubstr(words));
  };
  run_fails("hang.sh: cannot be started: Permission denied");
  fs::permissions(files_ / "hang.sh", fs::perms::owner_all);
  run_fails("hang.sh: no answer within 0.3 s");
  method["settings"]["program"] = "nowhere.sh";
  files_.Write("method.json", method);
  run_fails("nowhere.sh: cannot be started: No such file or directory");
}

}  // namespace
}  // namespace vitruvia
