#include "records/run_record.h"

#include <cmath>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>

#include "core/error.h"
#include "core/files.h"

namespace vitruvia {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class RunRecordTest : public testing::Test {
 protected:
  RunRecordTest() { fs::remove_all(folder_); }
  ~RunRecordTest() override { fs::remove_all(folder_); }
  fs::path folder_ =
      fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
};

RunRecord SomeRun() {
  RunRecord r;
  r.run_id = "fig11-base-s1";
  r.experiment = "realtime_scape/fig11";
  r.variant = "base";
  r.scene = "walk";
  r.method = "realtime_scape";
  r.seed = 1;
  r.sequence_folder = "../../cache/walk";
  r.sequence_hash = "0123456789abcdef";
  r.config = {{"method", {{"lambda", 0.1}}}};
  r.provenance = {{"commit", "abc"}, {"threads", 2}};
  r.summary = {{"l2_mean_m", 1.0 / 3.0}, {"variant", "base"}, {"condition_max", kInfinity}};
  r.frames = {{"l2_mean_m", {0.1, std::nextafter(0.1, 1.0)}},
              {"l2_mean_hidden_m", {kNan, 5e-324}},
              {"condition", {-kInfinity, kInfinity}}};
  r.threshold_m = {0.0, 0.1, 0.2};
  r.joint_accuracy = {{"all", {0.0, 0.7, 1.0}}, {"hidden", {0.0, 0.1, 0.2}}};
  r.joint_error_mean_m = {{"left_wrist", 0.012345678901234567}, {"head", kNan}};
  r.steps = {{"render", 0.5, 0.75, 1.0}, {"assemble", 0.1, 0.2, 0.3}};
  r.diagonal_m = 2.5 / 7.0;
  return r;
}

std::string MessageOfReading(const fs::path& folder, const std::string& run_id) {
  try {
    ReadRunRecord(folder, run_id);
  } catch (const DataError& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(RunRecordTest, RoundTripsEveryNumberExactly) {
  const RunRecord written = SomeRun();
  WriteRunRecord(folder_, written);
  const RunRecord read = ReadRunRecord(folder_, written.run_id);
  EXPECT_EQ(StoredJson(read), StoredJson(written));  // every text, and numbers to the bit
  EXPECT_EQ(read.frames.at("l2_mean_m"), written.frames.at("l2_mean_m"));
  EXPECT_TRUE(std::isnan(read.frames.at("l2_mean_hidden_m")[0]));
  EXPECT_EQ(read.frames.at("l2_mean_hidden_m")[1], 5e-324);
  EXPECT_EQ(read.frames.at("condition"), written.frames.at("condition"));
  EXPECT_EQ(read.summary, written.summary);
  EXPECT_EQ(read.joint_error_mean_m.size(), 1u);  // that of the head is absent
  EXPECT_EQ(read.diagonal_m, 2.5 / 7.0);
  EXPECT_EQ(read.steps[1].name, "assemble");
  EXPECT_EQ(read.steps[0].p95_ms, 0.75);
}

TEST_F(RunRecordTest, RefusesToStoreWhatJsonCannotHold) {
  RunRecord record = SomeRun();
  record.summary["l2_mean_m"] = kNan;
  EXPECT_THAT([&] { WriteRunRecord(folder_, record); },
              testing::ThrowsMessage<std::invalid_argument>(
                  "summary.l2_mean_m = nan: only finite numbers can be stored"));
  record = SomeRun();
  record.steps[1].p95_ms = kInfinity;
  EXPECT_THAT([&] { WriteRunRecord(folder_, record); },
              testing::ThrowsMessage<std::invalid_argument>(HasSubstr("steps[1].p95_ms = inf")));
  record = SomeRun();
  record.config["method"]["lambda"] = kInfinity;
  EXPECT_THAT(
      [&] { WriteRunRecord(folder_, record); },
      testing::ThrowsMessage<std::invalid_argument>(HasSubstr("config.method.lambda = inf")));
  record = SomeRun();
  record.summary["l2_meen_m"] = 0.1;
  EXPECT_THAT([&] { WriteRunRecord(folder_, record); },
              testing::ThrowsMessage<std::invalid_argument>(
                  "summary: unknown metric \"l2_meen_m\"; did you mean \"l2_mean_m\"?"));
  EXPECT_FALSE(fs::exists(folder_));
}

// A text in a number's place would pass for a number that was not measured.
TEST_F(RunRecordTest, RefusesTextsInThePlacesOfNumbers) {
  const RunRecord record = SomeRun();
  WriteRunRecord(folder_, record);
  const fs::path file = folder_ / record.run_id / "record.json";
  const json whole = json::parse(ReadWholeFile(file));
  const auto refused = [&](const char* place, const json& value, const std::string& words) {
    json edited = whole;
    edited[json::json_pointer(place)] = value;
    WriteWholeFile(file, edited.dump());
    EXPECT_THAT(MessageOfReading(folder_, record.run_id), HasSubstr(words));
  };
  refused("/summary/l2_mean_m", "0.3", "summary.l2_mean_m: expected a number, got \"0.3\"");
  refused("/summary/frames", nullptr, "summary.frames: expected a number, got null");
  refused("/summary/repeat", "2", "summary.repeat: expected a number");
  refused("/provenance/threads", "2", "provenance/threads: expected a number");
  refused("/provenance/commit", 7, "provenance/commit: expected a text, got 7");
}

TEST_F(RunRecordTest, NamesFileAndKeyOfEveryMissingKey) {
  const RunRecord record = SomeRun();
  WriteRunRecord(folder_, record);
  const fs::path file = folder_ / record.run_id / "record.json";
  const json whole = json::parse(ReadWholeFile(file));
  for (const auto& item : whole.items()) {
    const bool is_optional = item.key() == "threshold_m" || item.key() == "diagonal_m" ||
                             item.key().starts_with("joint_");
    if (is_optional) continue;
    json damaged = whole;
    damaged.erase(item.key());
    WriteWholeFile(file, damaged.dump());
    EXPECT_THAT(MessageOfReading(folder_, record.run_id),
                testing::StartsWith(file.string() + ": " + item.key() + ": missing; expected"));
  }
  json damaged = whole;
  damaged["steps"][1].erase("p95_ms");
  WriteWholeFile(file, damaged.dump());
  EXPECT_THAT(MessageOfReading(folder_, record.run_id),
              HasSubstr(file.string() + ": steps[1].p95_ms: missing"));
}

TEST_F(RunRecordTest, NamesWhatIsInconsistent) {
  const RunRecord record = SomeRun();
  WriteRunRecord(folder_, record);
  const fs::path file = folder_ / record.run_id / "record.json";
  const json whole = json::parse(ReadWholeFile(file));

  json damaged = whole;
  damaged["frames"]["l2_mean_m"].erase(1);  // the first series has two
  WriteWholeFile(file, damaged.dump());
  EXPECT_THAT(MessageOfReading(folder_, record.run_id),
              HasSubstr("frames.l2_mean_m: expected 2 values, got 1"));

  damaged = whole;
  damaged["joint_accuracy"]["all"].push_back(1.0);
  WriteWholeFile(file, damaged.dump());
  EXPECT_THAT(MessageOfReading(folder_, record.run_id),
              HasSubstr("joint_accuracy.all: expected 3 values, got 4"));

  damaged = whole;
  damaged["seed"] = "one";
  WriteWholeFile(file, damaged.dump());
  EXPECT_EQ(MessageOfReading(folder_, record.run_id),
            file.string() + ": seed: expected a whole number, got \"one\"");

  damaged = whole;
  damaged["run_id"] = "another";
  WriteWholeFile(file, damaged.dump());
  EXPECT_THAT(MessageOfReading(folder_, record.run_id),
              HasSubstr("run_id: expected the folder's name \"fig11-base-s1\", got \"another\""));

  WriteWholeFile(file, whole.dump().substr(0, 100));
  EXPECT_THAT(MessageOfReading(folder_, record.run_id),
              HasSubstr(file.string() + ": not valid JSON: "));
  EXPECT_THAT(MessageOfReading(folder_, "absent"), HasSubstr("cannot be opened"));
}

TEST_F(RunRecordTest, ExperimentRoundTripsWithAndWithoutATarget) {
  ExperimentRecord written;
  written.name = "realtime_scape/fig11";
  written.title = "Figure 11";
  written.description = "Mean and maximum error.";
  written.expectations = {{"l2_mean_of_diagonal", 0.001, 0.001, "paper A, figure 11", "other body"},
                          {"frame_ms_median", 25.0, kNan, "paper A, table 1", "other CPU"}};
  written.picture_frames = {0, 150};
  written.side_by_side = true;
  written.run_ids = {"a", "b"};
  written.failed_runs = {{"b", "lost in frame 3"}};
  WriteExperimentRecord(folder_, written);
  const ExperimentRecord read = ReadExperimentRecord(folder_);
  EXPECT_EQ(StoredJson(read), StoredJson(written));
  EXPECT_TRUE(std::isnan(read.expectations[1].at_most));
  EXPECT_FALSE(StoredJson(written)["expectations"][1].contains("at_most"));

  json damaged = StoredJson(written);
  damaged["expectations"][1].erase("source");
  WriteWholeFile(folder_ / "experiment.json", damaged.dump());
  EXPECT_THAT([&] { ReadExperimentRecord(folder_); },
              testing::ThrowsMessage<DataError>(HasSubstr((folder_ / "experiment.json").string() +
                                                          ": expectations[1].source: missing")));
}

// As it was written before records had a version.
json OldRecord() {
  json old = StoredJson(SomeRun());
  old["summary"].erase("condition_max");
  old["frames"].erase("condition");
  old["joint_error_mean_m"]["head"] = nullptr;
  return old;
}

TEST_F(RunRecordTest, RecordWithoutAVersionIsReadCompletelyOrRefused) {
  MakeFolder(folder_ / "fig11-base-s1");
  const fs::path file = folder_ / "fig11-base-s1/record.json";
  WriteWholeFile(file, OldRecord().dump());
  const RunRecord read = ReadRunRecord(folder_, "fig11-base-s1");
  EXPECT_EQ(read.summary.at("l2_mean_m"), 1.0 / 3.0);
  EXPECT_EQ(read.frames.size(), 2u);
  EXPECT_EQ(read.steps.size(), 2u);
  EXPECT_EQ(read.diagonal_m, 2.5 / 7.0);
  json without_surface = OldRecord();
  without_surface["diagonal_m"] = 0.0;
  WriteWholeFile(file, without_surface.dump());
  EXPECT_TRUE(std::isnan(ReadRunRecord(folder_, "fig11-base-s1").diagonal_m));
  json older = OldRecord();
  older.erase("steps");
  WriteWholeFile(file, older.dump());
  const std::string refusal = MessageOfReading(folder_, "fig11-base-s1");
  EXPECT_THAT(refusal, HasSubstr(file.string() + ": steps: missing"));
  EXPECT_THAT(refusal, HasSubstr("an older version of vitruvia wrote"));
  EXPECT_THAT(refusal, HasSubstr("run the experiment again"));
}

TEST_F(RunRecordTest, SummaryRoundTripsAndReadsWhatHadNoVersion) {
  MakeFolder(folder_);
  ExperimentSummary written;
  written.experiment = "fig11";
  written.failed_runs = {{"b", "lost"}};
  written.missing_runs = {"c"};
  written.rows = {{{"run_id", "a"}, {"condition_max", kInfinity}}};
  WriteExperimentSummary(folder_, written);
  const std::string text = ReadWholeFile(folder_ / "summary.json");
  EXPECT_THAT(text, testing::StartsWith("{\n  \"format\": \"vitruvia-summary\""));
  EXPECT_THAT(text, HasSubstr("\"condition_max\": \"Infinity\""));
  EXPECT_EQ(ReadSummary(folder_).rows, written.rows);
  WriteWholeFile(folder_ / "summary.json", StoredJson(written).dump());  // without a header
  EXPECT_EQ(StoredJson(ReadSummary(folder_)), StoredJson(written));
  WriteWholeFile(folder_ / "summary.json", R"({"experiment": "fig11", "rows": []})");
  EXPECT_THAT([&] { ReadSummary(folder_); },
              testing::ThrowsMessage<DataError>(HasSubstr("an older version of vitruvia wrote")));
}

TEST_F(RunRecordTest, FolderWithoutAnExperimentIsBadData) {
  EXPECT_THROW(ReadExperimentRecord(folder_), DataError);
}

}  // namespace
}  // namespace vitruvia
