// What all baselines that track an articulated body must do, on depth drawn by the z-buffer.
#include <gtest/gtest.h>

#include "core/error.h"
#include "math/rigid.h"
#include "methods/registry.h"
#include "support/arm_stage.h"

namespace vitruvia {
namespace {

const Rigidd kCameraFromSubject{Vector3d(1, -1, -1).asDiagonal(), {0.05, 0.9, 2.8}};

struct Stage : ArmStage {
  Stage() : ArmStage(1, SkinLinear, kCameraFromSubject) {}
};

class ArticulatedMethod : public testing::TestWithParam<const char*> {
 protected:
  std::unique_ptr<Tracker> Started(const Stage& stage, Json settings = Json::object()) const {
    settings["field"]["cell_m"] = 0.02;
    if (std::string(GetParam()) != "sdf_parts") settings.erase("field");
    std::unique_ptr<Tracker> tracker =
        MakeTracker(ReadMethodConfig({{"method", GetParam()}, {"settings", settings}}, {"", ""}));
    tracker->Start(stage.body, stage.camera);
    return tracker;
  }
};

TEST_P(ArticulatedMethod, FollowsAMovingArm) {
  Stage stage;
  const auto tracker = Started(stage);
  for (int i = 0; i <= 12; ++i) {
    const double angle = 0.05 * i;  // 1.5 rad/s
    const TrackResult result = tracker->TrackFrame(stage.Frame(i, angle));
    EXPECT_FALSE(IsFailure(result.outcome)) << result.message;
    EXPECT_LT(stage.MeanError(result, angle), 0.02) << "frame " << i;
    EXPECT_EQ(result.joints.size(), std::size_t{kBoneCount});
    EXPECT_EQ(result.vertices.size(), stage.body.rest.vertices.size());
  }
}

TEST_P(ArticulatedMethod, StaysWhereAStillBodyIs) {
  Stage stage;
  const auto tracker = Started(stage);
  TrackResult before, after;
  for (int i = 0; i < 15; ++i) before = tracker->TrackFrame(stage.Frame(i, 0.3));
  for (int i = 15; i < 20; ++i) after = tracker->TrackFrame(stage.Frame(i, 0.3));
  double sum = 0.0;
  for (int b = 0; b < kBoneCount; ++b) sum += (after.joints[b] - before.joints[b]).norm();
  EXPECT_LT(sum / kBoneCount, 0.002);
}

TEST_P(ArticulatedMethod, GivesTheSameForAnyNumberOfThreads) {
  const auto run = [&](int threads) {
    Stage stage;
    const auto tracker = Started(stage, {{"threads", threads}});
    TrackResult result;
    for (int i = 0; i < 4; ++i) result = tracker->TrackFrame(stage.Frame(i, 0.05 * i));
    return result;
  };
  const TrackResult one = run(1), two = run(2);
  EXPECT_EQ(one.vertices, two.vertices);
  EXPECT_EQ(one.iterations, two.iterations);
  for (std::size_t k = 0; k < one.energies.size(); ++k) {
    EXPECT_EQ(one.energies[k].value, two.energies[k].value);
  }
}

TEST_P(ArticulatedMethod, CarriesThePoseOverAnEmptyFrameAndGoesOn) {
  Stage stage;
  const auto tracker = Started(stage);
  const TrackResult before = tracker->TrackFrame(stage.Frame(0, 0.0));
  const TrackResult empty = tracker->TrackFrame({1, 1 / 30.0, DepthImage(320, 240)});
  EXPECT_EQ(empty.outcome, Outcome::kNoData);
  EXPECT_EQ(empty.vertices, before.vertices);
  EXPECT_EQ(empty.energies.size(), before.energies.size());
  const TrackResult after = tracker->TrackFrame(stage.Frame(2, 0.0));
  EXPECT_FALSE(IsFailure(after.outcome)) << after.message;
  EXPECT_LT(stage.MeanError(after, 0.0), 0.02);
}

TEST_P(ArticulatedMethod, SaysLostWhenTheDataAreElsewhereAndFindsTheBodyAgain) {
  Stage stage;
  const auto tracker = Started(stage);
  tracker->TrackFrame(stage.Frame(0, 0.0));
  const TrackResult lost = tracker->TrackFrame({1, 1 / 30.0, DepthImage(320, 240, 6.0f)});
  EXPECT_EQ(lost.outcome, Outcome::kLost);
  for (const Vector3f& vertex : lost.vertices) ASSERT_TRUE(vertex.allFinite());
  TrackResult after;
  for (int i = 2; i < 6; ++i) after = tracker->TrackFrame(stage.Frame(i, 0.0));
  EXPECT_FALSE(IsFailure(after.outcome)) << after.message;
  EXPECT_LT(stage.MeanError(after, 0.0), 0.03);
}

TEST_P(ArticulatedMethod, RefusesWhatItCannotUse) {
  Stage stage;
  std::unique_ptr<Tracker> tracker =
      MakeTracker(ReadMethodConfig({{"method", GetParam()}}, {"", ""}));
  EXPECT_THROW(tracker->TrackFrame(stage.Frame(0, 0.0)), std::invalid_argument);  // before Start
  BodyModel other_weights = stage.body;
  other_weights.weights.bones[3][0] = 40;
  EXPECT_THROW(tracker->Start(other_weights, stage.camera), DataError);
  tracker = Started(stage);
  EXPECT_THROW(tracker->TrackFrame({0, 0.0, DepthImage(64, 48)}), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Baselines, ArticulatedMethod,
                         testing::Values("capsule_icp", "sdf_parts", "gmm_articulated"),
                         [](const auto& method) { return std::string(method.param); });

}  // namespace
}  // namespace vitruvia
