// Metrics computed again from what runs left behind.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.h"
#include "experiments/command_line.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Rescore : public testing::Test {
 protected:
  Rescore() {
    EXPECT_EQ(CallVitruvia({"run", files_.File("experiment.json"), "-o", out_.string()}).code, 0);
    const Json summary = ReadJsonFile(out_ / "summary.json");
    run_ = out_ / summary.at("rows").at(0).at("run_id").get<std::string>();
  }

  Json Record() const {
    Json record = ReadJsonFile(run_ / "record.json");
    record.erase("provenance");
    return record;
  }

  SmallExperiment files_;
  fs::path out_ = files_ / "out", run_;
};

TEST_F(Rescore, GivesTheSameNumbersWithoutTracking) {
  const Json before = Record();
  const std::string summary = ReadWholeFile(out_ / "summary.json");
  for (const char* series : {"l2_mean_m", "l2_median_m", "l2_p95_m", "l2_p99_m", "l2_max_m"}) {
    EXPECT_EQ(before.at("frames").at(series).size(), 12u) << series;
  }
  const CallResult call = CallVitruvia({"rescore", out_.string()});
  ASSERT_EQ(call.code, 0) << call.error;
  EXPECT_THAT(call.out, HasSubstr("1 runs scored again, 0 changed"));
  EXPECT_EQ(Record(), before);
  EXPECT_EQ(ReadWholeFile(out_ / "summary.json"), summary);
  const Json provenance = ReadJsonFile(run_ / "record.json").at("provenance");
  EXPECT_EQ(provenance.at("rescored_by").at("build_id"), provenance.at("build_id"));
}

TEST_F(Rescore, RepairsARecordWhoseNumbersAreWrong) {
  const Json before = Record();
  Json record = ReadJsonFile(run_ / "record.json");
  record["summary"]["l2_mean_m"] = 7.0;
  record["frames"]["l2_mean_m"][3] = 7.0;
  files_.Write(fs::relative(run_ / "record.json", files_.path()), record);
  const CallResult call = CallVitruvia({"rescore", out_.string(), "--only", "default.*"});
  EXPECT_THAT(call.out, HasSubstr("1 runs scored again, 1 changed"));
  EXPECT_EQ(Record(), before);
}

// Summaries that were not in the experiment when it was carried out, against the stored series.
TEST_F(Rescore, ComputesSummariesOfTheExperimentFile) {
  const std::vector<double> errors = Record().at("frames").at("joint_error_mean_m");
  std::vector<double> sorted = errors;
  std::sort(sorted.begin(), sorted.end());
  const double level = 0.5 * (sorted[3] + sorted[4]);  // 8 of 12 are above
  Json experiment = ReadJsonFile(files_ / "experiment.json");
  experiment["summaries"] = {
      {{"name", "median"}, {"series", "joint_error_mean_m"}, {"statistic", "median"}},
      {{"name", "worst"}, {"series", "joint_error_mean_m"}, {"statistic", "maximum"}},
      {{"name", "p90"},
       {"series", "joint_error_mean_m"},
       {"statistic", "quantile"},
       {"quantile", 0.9}},
      {{"name", "above"},
       {"series", "joint_error_mean_m"},
       {"statistic", "share_above"},
       {"level", level}},
      {{"name", "elbow"},
       {"series", "joint_error_mean_m"},
       {"joints", {"left_elbow"}},
       {"statistic", "mean"}}};
  experiment["table_columns"] = {"summary[above]"};
  files_.Write("experiment.json", experiment);
  const CallResult call =
      CallVitruvia({"rescore", files_.File("experiment.json"), "-o", out_.string()});
  ASSERT_EQ(call.code, 0) << call.error;
  const Json row = Record().at("summary");
  EXPECT_DOUBLE_EQ(row.at("summary[median]"), 0.5 * (sorted[5] + sorted[6]));
  EXPECT_DOUBLE_EQ(row.at("summary[worst]"), sorted.back());
  EXPECT_NEAR(row.at("summary[p90]").get<double>(), sorted[9] + 0.9 * (sorted[10] - sorted[9]),
              1e-15);
  EXPECT_DOUBLE_EQ(row.at("summary[above]"), 8.0 / 12.0);
  EXPECT_NEAR(row.at("summary[elbow]").get<double>(),
              Record().at("joint_error_mean_m").at("left_elbow").get<double>(), 1e-12);
  ASSERT_EQ(CallVitruvia({"report", out_.string()}).code, 0);
  EXPECT_THAT(ReadWholeFile(out_ / "table.tex"), HasSubstr("above"));

  // What an experiment asks for in vain is told.
  experiment["summaries"] = {{{"name", "x"},
                              {"series", "joint_error_mean_m"},
                              {"joints", {"left_elbo"}},
                              {"statistic", "mean"}}};
  files_.Write("experiment.json", experiment);
  ExpectRefusal({"rescore", files_.File("experiment.json"), "-o", out_.string()},
                ExitCode::kBadConfiguration, {"did you mean \"left_elbow\"?"});
}

TEST_F(Rescore, WhatIsMissingOrAnotherIsTold) {
  ExpectRefusal({"rescore", files_.File("nowhere")}, ExitCode::kBadData, {"experiment.json"});
  ExpectRefusal({"rescore", out_.string(), "--only", "x"}, ExitCode::kBadConfiguration,
                {"--only x: matches none of the 1 runs; the first is default.scene"});
  const Json record = ReadJsonFile(run_ / "record.json");
  const std::string sequence = record.at("sequence_folder");
  const fs::path joints = out_ / sequence / "truth" / "joints.json";
  const std::string text = ReadWholeFile(joints);
  WriteWholeFile(joints, text + " ");
  ExpectRefusal({"rescore", out_.string()}, ExitCode::kBadData,
                {"is another sequence than the one that was tracked: expected hash"});
  fs::remove(run_ / "estimate" / "vertices.bin");
  WriteWholeFile(joints, text);
  ExpectRefusal({"rescore", out_.string()}, ExitCode::kBadData, {"vertices.bin"});
}

TEST_F(Rescore, ARunWithoutAFileOfItsEstimateIsSkippedByNameAndMadeAgain) {
  const fs::path vertices = run_ / "estimate" / "vertices.bin";
  fs::remove(vertices);
  for (const char* command : {"rescore", "view", "export"})
    ExpectRefusal({command, out_.string()}, ExitCode::kBadData,
                  {run_.filename().string() + ": skipped: ", "vertices.bin",
                   "1 run could not be read and was skipped"});
  EXPECT_TRUE(fs::exists(out_ / "report.html"));
  EXPECT_THAT(CallVitruvia({"status", out_.string()}).out, HasSubstr("damaged"));
  EXPECT_EQ(CallVitruvia({"run", files_.File("experiment.json"), "-o", out_.string()}).code, 0);
  EXPECT_TRUE(fs::exists(vertices));
}

// Its titles, columns and summaries would replace those of the experiment that was carried out.
TEST_F(Rescore, AnotherExperimentsFileIsRefused) {
  files_.Write("other.json", SmallExperiment::Config());
  for (const char* command : {"rescore", "report", "status"})
    ExpectRefusal({command, files_.File("other.json"), "-o", out_.string()},
                  ExitCode::kBadConfiguration, {"holds the output of another experiment file"});
}

TEST_F(Rescore, ADamagedSequenceIsToldWithItsRemedy) {
  const fs::path sequence =
      out_ / ReadJsonFile(run_ / "record.json").at("sequence_folder").get<std::string>();
  fs::remove(sequence / "depth" / "000003.png");
  const std::vector<std::string> again = {"run", files_.File("experiment.json"), "-o",
                                          out_.string(), "--again"};
  ExpectRefusal(again, ExitCode::kFailedRun,
                {"frame 3 is missing", "and the next run generates it again", "remove the folder"});
  fs::remove_all(sequence);
  EXPECT_EQ(CallVitruvia(again).code, 0);
}

TEST_F(Rescore, OnePageOfAnExperimentsFolderIsRefused) {
  ExpectRefusal({"view", out_.string(), "-o", files_.File("page.html")},
                ExitCode::kBadConfiguration, {"is an experiment's folder", "RUN_ID"});
  EXPECT_THAT(CallVitruvia({"view", "--help"}).out, HasSubstr("folder alone"));
}

TEST_F(Rescore, ExportWritesMeshesAndRefusesFramesThatAreNotThere) {
  const CallResult call = CallVitruvia({"export", out_.string(), "--frames", "0", "11"});
  ASSERT_EQ(call.code, 0) << call.error;
  EXPECT_THAT(call.out, HasSubstr("meshes/estimate.pvd: 2 frames"));
  for (const char* file : {"estimate_000000.vtp", "truth_000011.vtp", "truth.pvd"})
    EXPECT_TRUE(fs::is_regular_file(run_ / "meshes" / file)) << file;
  ExpectRefusal({"export", out_.string(), "--frames", "12"}, ExitCode::kBadConfiguration,
                {"there is no frame 12: expected 0 … 11"});
  ExpectRefusal({"export", out_.string(), "--only", "x*"}, ExitCode::kBadConfiguration,
                {"--only x*: matches none of the 1 runs"});
}

}  // namespace
}  // namespace vitruvia
