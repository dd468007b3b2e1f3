#include "scoring/score.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "body/skeleton.h"
#include "support/temporary_folder.h"
#include "support/tiny_body.h"

namespace vitruvia {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kFrames = 3, kFrameOutOfView = 1;
constexpr float kError_m = 0.01f;

// A body that stands before the camera in the first and the last of three frames. In between it is
// beside the image, and that depth frame is empty.
class Score : public testing::Test {
 protected:
  Score() {
    info_.camera = {32, 24, 20.0, 20.0, 15.5, 11.5};
    info_.frames = kFrames;
    info_.joints = {"neck"};
    SequenceWriter writer(SequenceFolder(), info_, body_, body_.rest);
    for (int frame = 0; frame < kFrames; ++frame) {
      const DepthImage depth(32, 24, frame == kFrameOutOfView ? 0.0f : 3.0f);
      writer.Append(depth, TrueVertices(frame), {{{0.0, 0.0, 3.0}}, {false}});
    }
    writer.Finish();
  }

  std::filesystem::path SequenceFolder() const { return folder_ / "sequence"; }

  std::vector<Vector3f> TrueVertices(int frame) const {
    std::vector<Vector3f> vertices = body_.rest.vertices;
    for (Vector3f& v : vertices)
      v += Vector3f(frame == kFrameOutOfView ? 100.0f : 0.0f, -1.0f, 3.0f);
    return vertices;
  }

  TrackResult Result(int frame) const {
    TrackResult result;
    result.outcome = Outcome::kConverged;
    result.vertices = TrueVertices(frame);
    for (Vector3f& v : result.vertices) v.x() += kError_m;
    result.joints.assign(kBoneCount, Vector3<double>(0.0, 0.0, 3.0));
    result.condition = 10.0;
    return result;
  }

  // The record of an estimate, written and read back.
  RunRecord Scored(const std::vector<TrackResult>& results, const ScoreSettings& settings = {}) {
    EstimateWriter writer(folder_ / "estimate", body_.rest);
    for (const TrackResult& result : results) writer.Append(result, 1.0);
    writer.Finish();
    RunRecord record;
    record.run_id = "run";
    record.config = record.provenance = record.summary = nlohmann::json::object();
    ScoreRun(SequenceReader(SequenceFolder()), EstimateReader(folder_ / "estimate"), settings,
             record);
    WriteRunRecord(folder_.path(), record);
    return ReadRunRecord(folder_.path(), "run");
  }

  TemporaryFolder folder_;
  BodyModel body_ = TinyBody();
  SequenceInfo info_;
};

TEST_F(Score, SingularSystemIsRecordedAsInfiniteCondition) {
  std::vector<TrackResult> results = {Result(0), Result(1), Result(2)};
  results[2].condition = kInfinity;
  const RunRecord record = Scored(results);
  EXPECT_EQ(record.frames.at("condition"), (std::vector<double>{10.0, 10.0, kInfinity}));
  EXPECT_EQ(record.summary.at("condition_max"), kInfinity);
  EXPECT_EQ(record.summary.at("non_finite"), 1);
}

TEST_F(Score, FrameWithoutMeasurementIsNotPartOfTheReconstructionError) {
  std::vector<TrackResult> results = {Result(0), Result(1), Result(2)};
  results[kFrameOutOfView] = Result(0);  // the tracker has lost the subject and stays where it was
  results[kFrameOutOfView].outcome = Outcome::kNoData;
  const RunRecord record = Scored(results, {.reconstruction_every = 1});
  EXPECT_LT(record.summary.at("reconstruction_p95_m"), 3.0);
  const RunRecord every_second = Scored(results, {.reconstruction_every = 2});  // frames 0 and 2
  EXPECT_EQ(record.summary.at("reconstruction_mean_m"),
            every_second.summary.at("reconstruction_mean_m"));
}

TEST_F(Score, ErrorOfNoVisibleVertexIsAbsentAndNotZero) {
  const RunRecord record = Scored({Result(0), Result(1), Result(2)});
  for (const char* key : {"l2_mean_visible_m", "l2_max_visible_m"}) {
    EXPECT_TRUE(std::isnan(record.frames.at(key)[kFrameOutOfView])) << key;
    EXPECT_NEAR(record.frames.at(key)[0], kError_m, 1e-6) << key;
    EXPECT_NEAR(record.summary.at(key), kError_m, 1e-6) << key;  // of the two frames that have one
  }
  EXPECT_NEAR(record.frames.at("l2_mean_hidden_m")[kFrameOutOfView], kError_m, 1e-5);
  EXPECT_EQ(record.summary.at("non_finite"), 0);
}

TEST_F(Score, StepsAndEnergiesThatAFrameLacksAreAbsentThere) {
  std::vector<TrackResult> results = {Result(0), Result(1), Result(2)};
  results[1].step_ms = {{"render", 1.0}, {"solve", 2.0}};
  results[2].step_ms = {{"solve", 4.0}};
  results[2].energies = {{"fit", 7.0}};
  const RunRecord record = Scored(results);
  ASSERT_EQ(record.steps.size(), 2u);
  EXPECT_EQ(record.steps[0].name, "render");
  EXPECT_EQ(record.steps[0].max_ms, 1.0);
  EXPECT_EQ(record.steps[1].name, "solve");
  EXPECT_EQ(record.steps[1].median_ms, 3.0);
  const std::vector<double>& fit = record.frames.at("energy_fit");
  EXPECT_TRUE(std::isnan(fit[0]) && std::isnan(fit[1]));
  EXPECT_EQ(fit[2], 7.0);
  EXPECT_EQ(record.summary.at("energy_mean"), 7.0);
}

TEST_F(Score, ObservationIsScoredOnRequestAndWhereThereIsNoTruth) {
  const std::vector<TrackResult> results = {Result(0), Result(1), Result(2)};
  EXPECT_FALSE(Scored(results).summary.contains("fit_m"));
  const RunRecord record = Scored(results, {.against_observation = AgainstObservation::kAlways});
  EXPECT_TRUE(std::isnan(record.frames.at("fit_m")[kFrameOutOfView]));
  EXPECT_TRUE(std::isfinite(record.frames.at("fit_m")[0]));
  EXPECT_EQ(record.frames.at("fit_m")[0], record.frames.at("fit_m")[2]);
  EXPECT_FALSE(record.summary.contains("limb_length_change"));  // all joints are in one place
  EXPECT_FALSE(Scored(results, {.against_observation = AgainstObservation::kNever})
                   .summary.contains("fit_m"));
}

// The true surface is the body with triangles of its own, a centimetre beside the estimate.
TEST(OwnSurfaceScore, IsTheDistanceInBothDirections) {
  const TemporaryFolder folder;
  const BodyModel body = TinyBody(2);
  SequenceInfo info;
  info.camera = {64, 48, 40.0, 40.0, 31.5, 23.5};
  info.frames = 1;
  info.surface = info.subject = false;
  info.own_surfaces = true;
  TriangleMesh truth = body.rest;
  for (Vector3f& v : truth.vertices) v += Vector3f(0.0f, -1.0f, 3.0f);
  {
    SequenceWriter writer(folder / "sequence", info, std::nullopt);
    writer.Append(DepthImage(64, 48, 3.0f), truth, JointTruth());
    writer.Finish();
    EstimateWriter estimate(folder / "estimate", body.rest);
    TrackResult result;
    result.outcome = Outcome::kConverged;
    result.vertices = truth.vertices;
    for (Vector3f& v : result.vertices) v.z() += kError_m;
    result.joints.assign(kBoneCount, Vector3<double>(0.0, 0.0, 3.0));
    estimate.Append(result, 1.0);
    estimate.Finish();
  }
  RunRecord record;
  record.summary = nlohmann::json::object();
  ScoreRun(SequenceReader(folder / "sequence"), EstimateReader(folder / "estimate"),
           ScoreSettings(), record);
  const auto value = [&](const char* key) { return record.summary.at(key).get<double>(); };
  // Nowhere more than the shift, and less where the surface is seen edgewise.
  for (const char* key : {"two_way_mean_m", "two_way_visible_mean_m", "to_truth_mean_m",
                          "from_truth_mean_m", "two_way_p95_m", "two_way_visible_p95_m"}) {
    EXPECT_LT(value(key), kError_m + 1e-5) << key;
    EXPECT_GT(value(key), 0.3 * kError_m) << key;
  }
  EXPECT_NEAR(value("two_way_p95_m"), kError_m, 0.1 * kError_m);
  EXPECT_DOUBLE_EQ(value("two_way_mean_m"),
                   0.5 * (value("to_truth_mean_m") + value("from_truth_mean_m")));
  EXPECT_EQ(record.summary.at("frames_lost"), 0);
  EXPECT_FALSE(record.summary.contains("l2_mean_m"));
  EXPECT_FALSE(record.summary.contains("fit_m"));
  EXPECT_THAT(record.summary.at("not_scored").get<std::string>(),
              testing::Not(testing::HasSubstr("surface")));
}

struct LimbCase {
  double camera_cy = 47.5;
  int unknown_frame = -1;        // in which the truth of the left wrist is not known
  int joint_count = kBoneCount;  // of the sequence, in the skeleton's order
};

// The summary of 14 frames in which the body stands before a camera. The estimate's left wrist is
// 20 cm off in frames 1 to 12, the right ankle in frames 1 to 10.
nlohmann::json LimbRow(const LimbCase& of) {
  const TemporaryFolder folder;
  const BodyModel body = TinyBody(2);
  SequenceInfo info;
  info.camera = {128, 96, 60.0, 60.0, 63.5, of.camera_cy};
  info.frames = 14;
  JointTruth truth;
  std::vector<Vector3d> joints;
  for (const Vector3d& joint : body.skeleton.joints)
    joints.emplace_back(joint.x(), 1.0 - joint.y(), 3.0 - joint.z());
  for (int j = 0; j < of.joint_count; ++j) {
    info.joints.emplace_back(Bones()[j].joint);
    truth.positions.push_back(joints[j]);
  }
  truth.visible.assign(of.joint_count, true);
  std::vector<Vector3f> vertices = body.rest.vertices;
  for (Vector3f& v : vertices) v = {v.x(), 1.0f - v.y(), 3.0f - v.z()};
  const int left_wrist = FindJoint("left_wrist"), right_ankle = FindJoint("right_ankle");
  SequenceWriter writer(folder / "sequence", info, body, body.rest);
  EstimateWriter estimate(folder / "estimate", body.rest);
  for (int frame = 0; frame < info.frames; ++frame) {
    JointTruth of_frame = truth;
    if (frame == of.unknown_frame) {
      of_frame.known.assign(of.joint_count, true);
      of_frame.known[left_wrist] = of_frame.visible[left_wrist] = false;
    }
    writer.Append(DepthImage(128, 96, 3.0f), vertices, of_frame);
    TrackResult result;
    result.outcome = Outcome::kConverged;
    result.vertices = vertices;
    result.joints = joints;
    if (frame >= 1 && frame <= 12) result.joints[left_wrist].x() += 0.2;
    if (frame >= 1 && frame <= 10) result.joints[right_ankle].x() += 0.2;
    estimate.Append(result, 1.0);
  }
  writer.Finish();
  estimate.Finish();
  RunRecord record;
  record.summary = nlohmann::json::object();
  ScoreRun(SequenceReader(folder / "sequence"), EstimateReader(folder / "estimate"),
           ScoreSettings(), record);
  return record.summary;
}

TEST(LimbScore, CountsTheFramesInWhichTheCameraSeesALostLimb) {
  const nlohmann::json row = LimbRow({});
  EXPECT_EQ(row.at("limb_losses"), 2);
  EXPECT_EQ(row.at("limbs_found_within_10_frames"), 0.5) << "10 frames of the ankle's, not 12";
}

TEST(LimbScore, ALimbBesideTheImageIsNoCase) {
  const nlohmann::json row = LimbRow({.camera_cy = 87.5});  // the image ends above the knees
  EXPECT_EQ(row.at("limb_losses"), 1);
  EXPECT_EQ(row.at("limbs_found_within_10_frames"), 0.0);
}

TEST(LimbScore, AFrameWithoutTruthDoesNotEndALoss) {
  const nlohmann::json row = LimbRow({.unknown_frame = 6});
  EXPECT_EQ(row.at("limb_losses"), 2);
  EXPECT_EQ(row.at("limbs_found_within_10_frames"), 0.5) << "11 frames of the wrist's";
}

TEST(LimbScore, IsAbsentWithoutTheJointsOfAllLimbs) {
  for (const int joint_count : {0, 5}) {
    const nlohmann::json row = LimbRow({.joint_count = joint_count});
    EXPECT_FALSE(row.contains("limb_losses")) << joint_count;
    EXPECT_TRUE(row.contains("l2_mean_m")) << joint_count;
  }
}

}  // namespace
}  // namespace vitruvia
