// Sequences are verified before the first frame of a track or a run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.h"
#include "experiments/command_line.h"
#include "records/run_record.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class VerifiedInput : public testing::Test {
 protected:
  VerifiedInput() {
    EXPECT_EQ(
        CallVitruvia({"synth", files_.File("scene.json"), "-o", files_.File("sequence")}).code, 0);
    files_.Write("experiment.json",
                 {{"title", "T"}, {"sequences", {"sequence"}}, {"methods", {"method.json"}}});
  }

  void Edit(const std::string& file, const std::function<void(Json&)>& change) const {
    Json json = ReadJsonFile(files_ / file);
    change(json);
    files_.Write(file, json);
  }

  CallResult Track() const {
    return CallVitruvia({"track", files_.File("method.json"), "--sequence", files_.File("sequence"),
                         "-o", files_.File("estimate")});
  }
  CallResult Run() const {
    return CallVitruvia({"run", files_.File("experiment.json"), "-o", files_.File("out")});
  }

  SmallExperiment files_;
};

TEST_F(VerifiedInput, WhatCannotBeTrueIsNotTracked) {
  Edit("sequence/sequence.json", [](Json& json) { json["depth_unit_m"] = 0.005; });
  const CallResult track = Track();
  EXPECT_EQ(track.code, static_cast<int>(ExitCode::kBadData)) << track.error;
  EXPECT_THAT(track.error, HasSubstr("depth looks 5 times too large"));
  EXPECT_FALSE(fs::exists(files_ / "estimate"));
  const CallResult run = Run();
  EXPECT_EQ(run.code, static_cast<int>(ExitCode::kFailedRun)) << run.error;
  const Json failed = ReadJsonFile(files_ / "out/summary.json").at("failed_runs");
  EXPECT_THAT(failed.dump(), HasSubstr("depth looks 5 times too large"));
}

TEST_F(VerifiedInput, WarningsArePrintedAndKeptInRecordAndReport) {
  Edit("sequence/subject/subject.json",
       [](Json& json) { json["height_m"] = 1.08 * json["height_m"].get<double>(); });
  Edit("sequence/sequence.json",
       [](Json& json) { json["provenance"]["warnings"] = {"told when it was made"}; });
  const CallResult track = Track();
  EXPECT_EQ(track.code, 0) << track.error;
  EXPECT_THAT(track.error, HasSubstr("warning: "));
  EXPECT_THAT(track.error, HasSubstr("subject/subject.json: height_m is"));
  ASSERT_EQ(Run().code, 0);
  const std::vector<std::string> runs = ReadExperimentRecord(files_ / "out").run_ids;
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_THAT(ReadRunRecord(files_ / "out", runs.front()).warnings,
              testing::ElementsAre("told when it was made",
                                   HasSubstr("subject/subject.json: height_m is")));
  const std::string report = ReadWholeFile(files_ / "out/report.html");
  EXPECT_THAT(report, HasSubstr("<b>Warning</b>"));
  EXPECT_THAT(report, HasSubstr("subject/subject.json: height_m is"));
  ASSERT_EQ(CallVitruvia({"rescore", files_.File("out")}).code, 0);
  EXPECT_EQ(ReadRunRecord(files_ / "out", runs.front()).warnings.size(), 2u);
}

}  // namespace
}  // namespace vitruvia
