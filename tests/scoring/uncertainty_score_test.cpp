#include "scoring/uncertainty_score.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/random.h"
#include "support/temporary_folder.h"
#include "support/tiny_body.h"

namespace vitruvia {
namespace {

constexpr int kUncertainFrames = 400;

// Joints whose errors are drawn from the covariance that is stored with them, times `factor`.
RunRecord ScoredWithErrors(double factor) {
  const TemporaryFolder folder;
  const BodyModel body = TinyBody();
  SequenceInfo info;
  info.camera = {8, 6, 5.0, 5.0, 3.5, 2.5};
  info.frames = kUncertainFrames;
  info.surface = info.subject = false;
  for (const BoneInfo& bone : Bones()) info.joints.emplace_back(bone.joint);
  SequenceWriter writer(folder / "sequence", info, std::nullopt);
  EstimateWriter estimate(folder / "estimate", body.rest);
  const Vector3d deviations_m(0.01, 0.02, 0.03);
  RandomStream random(1, "errors");
  for (int frame = 0; frame < kUncertainFrames; ++frame) {
    JointTruth truth;
    TrackResult result;
    result.outcome = Outcome::kConverged;
    result.vertices = body.rest.vertices;
    for (int j = 0; j < kBoneCount; ++j) {
      truth.positions.emplace_back(0.0, 0.1 * j, 3.0);
      truth.visible.push_back(true);
      Vector3d error;
      for (int k = 0; k < 3; ++k) error[k] = factor * deviations_m[k] * random.Normal();
      result.joints.emplace_back(truth.positions.back() + error);
      result.joint_covariances.emplace_back(deviations_m.cwiseAbs2().asDiagonal());
    }
    result.unreliable_joints.assign(kBoneCount, false);
    result.unreliable_joints[2] = true;
    writer.Append(DepthImage(8, 6), truth);
    estimate.Append(result, 1.0);
  }
  writer.Finish();
  estimate.Finish();
  RunRecord record;
  record.summary = nlohmann::json::object();
  ScoreUncertainty(SequenceReader(folder / "sequence"), EstimateReader(folder / "estimate"),
                   record);
  return record;
}

TEST(UncertaintyScore, TrueCovariancesCoverWhatTheyShould) {
  const RunRecord record = ScoredWithErrors(1.0);
  EXPECT_NEAR(record.summary["coverage_68"], 0.68, 0.015);
  EXPECT_NEAR(record.summary["coverage_95"], 0.95, 0.01);
  EXPECT_EQ(record.summary["covariances_given"], 1.0);
  const double expected =
      1.5 + 1.5 * std::log(2.0 * std::numbers::pi) + std::log(0.01 * 0.02 * 0.03);
  EXPECT_NEAR(record.summary["negative_log_likelihood"], expected, 0.05);
  EXPECT_NEAR(record.summary["unreliable_false_alarms"], 1.0 / kBoneCount, 0.01);
}

TEST(UncertaintyScore, ErrorsTwiceAsLargeAreCoveredLess) {
  const RunRecord record = ScoredWithErrors(2.0);
  // P(χ²₃ ≤ 3.506 / 4) and P(χ²₃ ≤ 7.815 / 4).
  EXPECT_NEAR(record.summary["coverage_68"], 0.1688, 0.02);
  EXPECT_NEAR(record.summary["coverage_95"], 0.4184, 0.02);
}

}  // namespace
}  // namespace vitruvia
