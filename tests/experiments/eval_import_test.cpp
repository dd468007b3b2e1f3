// A synthesised sequence written as a file of Stanford EVAL and imported again: the same depth, the
// same camera, the same joints, and the same score of a tracker.
#include "importers/eval_import.h"

#include <cmath>

#include <gmock/gmock.h>

#include "core/files.h"
#include "experiments/command_line.h"
#include "sequence/sequence.h"
#include "support/eval_file_writer.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr int kWavingFrames = 6;
constexpr int kFirstId = 100;

class EvalImporter : public testing::Test {
 protected:
  EvalImporter() {
    Json scene = ReadJsonFile(files_ / "scene.json");
    scene["frames"] = kWavingFrames;
    scene["view"]["camera"] = {{"width", 320}, {"height", 240}, {"fx", 285.0},
                               {"fy", 283.0},  {"cx", 160.5},   {"cy", 118.25}};
    files_.Write("scene.json", scene);
    EXPECT_EQ(
        CallVitruvia({"synth", files_.File("scene.json"), "-o", files_.File("original")}).code, 0);
    original_.emplace(files_ / "original");
    frames_ = EvalFramesOf(*original_, kFirstId);
  }

  CallResult Import(const Json& config = Json::object()) const {
    files_.Write("import.json", config);
    WriteEvalFile(files_ / "seq_a_0.bin", frames_);
    return CallVitruvia({"import", "eval", files_.File("seq_a_0.bin"), "--config",
                         files_.File("import.json"), "-o", files_.File("imported")});
  }

  SequenceReader Imported(const Json& config = Json::object()) const {
    const CallResult call = Import(config);
    EXPECT_EQ(call.code, 0) << call.error;
    VerifySequence(files_ / "imported");
    return SequenceReader(files_ / "imported");
  }

  void ExpectRefused(ExitCode code, const std::vector<std::string>& words,
                     const Json& config = Json::object()) const {
    const CallResult call = Import(config);
    EXPECT_EQ(call.code, static_cast<int>(code)) << call.error;
    for (const std::string& word : words) EXPECT_THAT(call.error, HasSubstr(word));
    EXPECT_FALSE(fs::exists(files_ / "imported"));
  }

  SmallExperiment files_;
  std::optional<SequenceReader> original_;
  std::vector<EvalFrameBytes> frames_;
};

TEST_F(EvalImporter, DepthCameraAndJointsComeBack) {
  const SequenceReader imported = Imported();
  const PinholeCamera &camera = imported.info().camera, &expected = original_->info().camera;
  EXPECT_NEAR(camera.fx, expected.fx, 1e-4);
  EXPECT_NEAR(camera.fy, expected.fy, 1e-4);
  EXPECT_NEAR(camera.cx, expected.cx, 1e-4);
  EXPECT_NEAR(camera.cy, expected.cy, 1e-4);
  EXPECT_FALSE(imported.info().surface);
  EXPECT_FALSE(imported.info().subject);
  EXPECT_EQ(imported.info().joints, original_->info().joints);
  ASSERT_EQ(imported.info().frames, kWavingFrames);
  for (int i = 0; i < kWavingFrames; ++i) {
    EXPECT_EQ(imported.ReadDepth(i).pixels(), original_->ReadDepth(i).pixels()) << i;
    const JointTruth &joints = imported.true_joints(i), &truth = original_->true_joints(i);
    EXPECT_EQ(joints.visible, truth.visible);
    for (std::size_t j = 0; j < joints.positions.size(); ++j) {
      EXPECT_TRUE(joints.Knows(j));
      EXPECT_LT((joints.positions[j] - truth.positions[j]).norm(), 1e-6) << j;
    }
  }
}

TEST_F(EvalImporter, FilesAreJoinedInTheirOrder) {
  WriteEvalFile(files_ / "b.bin", {frames_.begin(), frames_.begin() + 2});
  WriteEvalFile(files_ / "a.bin", {frames_.begin() + 3, frames_.end()});
  const CallResult call = CallVitruvia({"import", "eval", files_.File("b.bin"),
                                        files_.File("a.bin"), "-o", files_.File("imported")});
  ASSERT_EQ(call.code, 0) << call.error;
  EXPECT_THAT(call.error,
              HasSubstr("1 of 5 frames do not have the number after their predecessor's"));
  const SequenceReader imported(files_ / "imported");
  ASSERT_EQ(imported.info().frames, kWavingFrames - 1);
  EXPECT_EQ(imported.ReadDepth(2).pixels(), original_->ReadDepth(3).pixels());
  EXPECT_EQ(imported.info().provenance.at("files"), Json({"b.bin", "a.bin"}));
  EXPECT_THAT(imported.info().provenance.at("warnings").dump(), HasSubstr("1 of 5 frames"));
}

TEST_F(EvalImporter, ATrackerScoresTheSameOnTheImportedSequence) {
  const Json subject = {{"name", "given"}, {"subject", "original/subject"}};
  ASSERT_EQ(Import().code, 0);
  files_.Write("both.json", {{"title", "Original and imported"},
                             {"sequences", {"original", "imported"}},
                             {"methods", {"method.json"}},
                             {"variants", {subject}}});
  const CallResult run = CallVitruvia({"run", files_.File("both.json"), "-o", files_.File("out")});
  ASSERT_EQ(run.code, 0) << run.error;
  const Json rows = ReadJsonFile(files_ / "out/summary.json").at("rows");
  ASSERT_EQ(rows.size(), 2u);
  const Json &original = rows[0], &imported = rows[1];
  EXPECT_EQ(original.at("scene"), "original");
  EXPECT_EQ(imported.at("scene"), "imported");
  // Points and joints have seven digits there: micrometres, which the tracker carries on.
  constexpr double kSame_m = 2e-5;
  for (const char* key : {"joint_error_mean_m", "joint_error_mean_visible_m", "joint_error_max_m"})
    EXPECT_NEAR(imported.at(key).get<double>(), original.at(key).get<double>(), kSame_m) << key;
  for (const char* key : {"joints_within_10cm", "joints_within_10cm_less_offset", "frames_failed"})
    EXPECT_EQ(imported.at(key), original.at(key)) << key;
  // What cannot be known is absent, not zero.
  EXPECT_EQ(imported.at("not_scored"), "surface: the sequence has no true surface");
  EXPECT_FALSE(original.contains("not_scored"));
  for (const char* key : {"l2_mean_m", "l2_max_of_diagonal", "diagonal_m", "twist_rms_deg",
                          "frames_lost", "surface_visible_mean_m"})
    EXPECT_FALSE(imported.contains(key)) << key;
  const std::string page = ReadWholeFile(files_ / "out/report.html");
  EXPECT_THAT(page, HasSubstr("<b>Not scored</b> · imported: surface: the sequence has no true"));
  const CallResult again = CallVitruvia({"rescore", files_.File("out")});
  EXPECT_THAT(again.out, HasSubstr("2 runs scored again, 0 changed")) << again.error;
}

// The imported sequence has no subject of its own. The run may be of an older version, whose
// methods had other settings.
TEST_F(EvalImporter, TheMotionIsExportedWithTheSubjectOfTheVariant) {
  const Json given = {{"name", "given"}, {"subject", "original/subject"}};
  ASSERT_EQ(Import().code, 0);
  files_.Write("given.json", {{"title", "Imported"},
                              {"sequences", {"imported"}},
                              {"methods", {"method.json"}},
                              {"variants", {given}}});
  const CallResult run = CallVitruvia({"run", files_.File("given.json"), "-o", files_.File("out")});
  ASSERT_EQ(run.code, 0) << run.error;
  const Json summary = ReadJsonFile(files_ / "out/summary.json");
  const fs::path plan =
      files_ / "out" / summary["rows"][0]["run_id"].get<std::string>() / "run.json";
  Json older = ReadJsonFile(plan);
  older["resolved"]["method"]["settings"]["no_setting_any_more"] = 1;
  WriteWholeFile(plan, older.dump());
  const CallResult call = CallVitruvia({"export", files_.File("out"), "--as", "bvh"});
  EXPECT_EQ(call.code, 0) << call.error;
  EXPECT_THAT(call.out, HasSubstr(fmt::format("joints.bvh: {} frames", kWavingFrames)));
}

TEST_F(EvalImporter, JointsThatAreHiddenFromTheRecordingAreNotScored) {
  constexpr int kHidden = 4;  // the head
  frames_[2].joints[kHidden].place = {0.0f, 0.0f, 0.0f};
  for (EvalFrameBytes& frame : frames_) --frame.joint_count;  // the right ankle is never there
  const SequenceReader imported = Imported({{"subject", "original/subject"}});
  EXPECT_EQ(imported.info().joints.size(), 16u);
  EXPECT_FALSE(imported.true_joints(2).Knows(kHidden));
  EXPECT_FALSE(imported.true_joints(2).visible[kHidden]);
  EXPECT_TRUE(imported.true_joints(3).Knows(kHidden));
  const CallResult track = CallVitruvia({"track", files_.File("method.json"), "--sequence",
                                         files_.File("imported"), "-o", files_.File("estimate")});
  ASSERT_EQ(track.code, 0) << track.error;
  const Json row = Json::parse(track.out);
  EXPECT_EQ(row.at("not_scored"),
            "surface: the sequence has no true surface; joints without truth: right_ankle");
  EXPECT_LT(row.at("joint_error_max_m").get<double>(), 0.1);  // not the way to (0, 0, 0)
}

TEST_F(EvalImporter, MarkersAndTheConfigNameJointsAndOthersAreReported) {
  for (EvalFrameBytes& frame : frames_) {
    EvalMarkerBytes& head = frame.markers[4];
    head.name = {};
    std::string("Hat").copy(head.name.data(), head.name.size());
    EvalMarkerBytes& elbow = frame.markers[6];
    elbow.name = {};
    std::string("Left Elbow").copy(elbow.name.data(), elbow.name.size());
    frame.markers[0].place = {0.0f, 0.0f, 0.0f};  // the pelvis has none
  }
  const CallResult call = Import();
  ASSERT_EQ(call.code, 0) << call.error;
  EXPECT_THAT(call.out, HasSubstr("joints that the skeleton has not: joint_100, hat\n"));
  EXPECT_THAT(call.out,
              HasSubstr("joints of the skeleton that the files have not: pelvis, head\n"));
  EXPECT_THAT(call.out, HasSubstr("the sequence has no subject: name one where it is tracked"));
  const SequenceReader told =
      Imported({{"joints", {{{"id", 104}, {"name", "head"}}, {{"id", 100}, {"name", "pelvis"}}}}});
  EXPECT_EQ(told.info().joints, original_->info().joints);
  EXPECT_EQ(told.info().provenance.at("joints_only_in_file"), Json::array());
}

TEST_F(EvalImporter, BackgroundGoesWhereTheConfigSaysSo) {
  const Vector3d wall(0.0, 0.0, 6.0);
  for (EvalFrameBytes& frame : frames_) {
    const PinholeCamera& camera = original_->info().camera;
    frame.points[0][0] = EvalPlace(camera.Unproject<double>(0.0, 0.0, wall.z()));
  }
  EXPECT_EQ(Imported().ReadDepth(0)(0, 0), 6.0f);
  const SequenceReader cut = Imported({{"person_within_m", 0.5}});
  EXPECT_EQ(cut.ReadDepth(0).pixels(), original_->ReadDepth(0).pixels());
}

TEST_F(EvalImporter, ASequenceWithoutSubjectIsTrackedOnlyWithOne) {
  ASSERT_EQ(Import().code, 0);
  const std::vector<std::string> track = {"track",      files_.File("method.json"),
                                          "--sequence", files_.File("imported"),
                                          "-o",         files_.File("estimate")};
  ExpectRefusal(track, ExitCode::kBadData, {"imported: the sequence has no subject"});
  std::vector<std::string> with_subject = track;
  with_subject.insert(with_subject.end(), {"--subject", files_.File("original/subject")});
  EXPECT_EQ(CallVitruvia(with_subject).code, 0);
  Json experiment = {{"title", "T"}, {"sequences", {"imported"}}, {"methods", {"method.json"}}};
  files_.Write("e.json", experiment);
  ExpectRefusal({"run", files_.File("e.json"), "-o", files_.File("out")}, ExitCode::kFailedRun,
                {"imported: the sequence has no subject"});
  experiment["variants"] = {{{"name", "v"}, {"subject", "method.json"}}};
  files_.Write("e.json", experiment);
  ExpectRefusal({"run", files_.File("e.json"), "-o", files_.File("never")},
                ExitCode::kBadConfiguration,
                {"method.json: expected the folder of a subject", "cannot be scanned"});
  experiment["variants"] = {{{"name", "v"}, {"scene", {{"frames", 3}}}}};
  files_.Write("e.json", experiment);
  ExpectRefusal({"run", files_.File("e.json"), "-o", files_.File("never")},
                ExitCode::kBadConfiguration, {"a stored sequence is as it is, got overrides"});
}

TEST_F(EvalImporter, DamagedFilesAreBadDataAndNothingIsWritten) {
  const std::vector<EvalFrameBytes> whole = frames_;
  frames_[3].points[7][7] = {0.0f, std::nanf(""), -1.0f};
  ExpectRefused(ExitCode::kBadData, {"seq_a_0.bin: frame 3, byte 2819084: column 7, row 7"});
  frames_.clear();
  ExpectRefused(ExitCode::kBadData, {"seq_a_0.bin: expected a whole number of frames"});
  frames_ = whole;
  for (EvalFrameBytes& frame : frames_) frame.points = {};
  ExpectRefused(ExitCode::kBadData, {"to fit the camera to, got 0 points"});
  frames_ = whole;
  for (EvalFrameBytes& frame : frames_) {  // rows from bottom to top
    for (int v = 0; v < 120; ++v) std::swap(frame.points[v], frame.points[239 - v]);
  }
  ExpectRefused(ExitCode::kBadData, {"on the rays of a pinhole camera", "fy -283"});
  frames_ = whole;
  for (EvalFrameBytes& frame : frames_) {  // millimetres of a lens that bends
    for (auto& row : frame.points) {
      for (auto& point : row) point[0] += 0.05f * point[0] * point[0];
    }
  }
  ExpectRefused(ExitCode::kBadData, {"within 0.1 px, got a residual of"});
  frames_ = whole;
  ExpectRefused(ExitCode::kBadData, {"joint 5 (\"head\") is seen in no frame; seen are: 100, 101"},
                {{"joints", {{{"id", 5}, {"name", "head"}}}}});
  ExpectRefused(ExitCode::kBadConfiguration, {"import.json: joints: id 5 stands twice"},
                {{"joints", {{{"id", 5}, {"name", "head"}}, {{"id", 5}, {"name", "neck"}}}}});
  ExpectRefused(ExitCode::kBadConfiguration, {"did you mean \"fps\"?"}, {{"fp", 3}});
}

}  // namespace
}  // namespace vitruvia
