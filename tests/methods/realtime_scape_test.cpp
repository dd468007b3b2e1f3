// The tracker as a whole, on depth drawn by the z-buffer.
#include "methods/realtime_scape/realtime_scape.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "math/rigid.h"
#include "methods/registry.h"
#include "support/arm_stage.h"

namespace vitruvia::realtime_scape {
namespace {

const Rigidd kCameraFromSubject{Vector3d(1, -1, -1).asDiagonal(), {0.05, 0.9, 2.8}};

struct Stage : ArmStage {
  Stage() : ArmStage(1, SkinLinear, kCameraFromSubject) {}
};

TEST(RealtimeScape, FollowsAMovingArm) {
  Stage stage;
  RealtimeScape tracker{Settings{}};
  tracker.Start(stage.body, stage.camera);
  for (int i = 0; i <= 20; ++i) {
    const double angle = 0.04 * i;  // 1.2 rad/s
    const TrackResult result = tracker.TrackFrame(stage.Frame(i, angle));
    EXPECT_FALSE(IsFailure(result.outcome)) << result.message;
    EXPECT_LT(stage.MeanError(result, angle), 0.01) << "frame " << i;
  }
}

// The cloud reads every second row and column: of one pixel it reads all or nothing.
TEST(RealtimeScape, SaysLostWhenAFrameHasTooFewPoints) {
  Stage stage;
  RealtimeScape tracker{Settings{}};
  tracker.Start(stage.body, stage.camera);
  const TrackResult before = tracker.TrackFrame(stage.Frame(0, 0.0));
  for (const int column : {160, 161}) {
    DepthFrame frame{1, 1 / 30.0, DepthImage(320, 240)};
    frame.depth(column, 120) = 2.8f;
    const TrackResult few = tracker.TrackFrame(frame);
    EXPECT_EQ(few.outcome, Outcome::kLost);
    EXPECT_THAT(few.message, testing::HasSubstr("1 measured pixel, too few to fix a pose"));
    EXPECT_EQ(few.vertices, before.vertices);
  }
}

TEST(RealtimeScape, CarriesThePoseOverAnEmptyFrameAndGoesOn) {
  Stage stage;
  RealtimeScape tracker{Settings{}};
  tracker.Start(stage.body, stage.camera);
  const TrackResult before = tracker.TrackFrame(stage.Frame(0, 0.0));
  const TrackResult empty = tracker.TrackFrame({1, 1 / 30.0, DepthImage(320, 240)});
  EXPECT_EQ(empty.outcome, Outcome::kNoData);
  EXPECT_EQ(empty.iterations, 0);
  EXPECT_EQ(empty.vertices, before.vertices);
  const TrackResult after = tracker.TrackFrame(stage.Frame(2, 0.0));
  EXPECT_FALSE(IsFailure(after.outcome)) << after.message;
  EXPECT_LT(stage.MeanError(after, 0.0), 0.01);
}

TEST(RealtimeScape, SaysLostWhenTheDataAreElsewhere) {
  Stage stage;
  RealtimeScape tracker{Settings{}};
  tracker.Start(stage.body, stage.camera);
  tracker.TrackFrame(stage.Frame(0, 0.0));
  DepthImage wall(320, 240, 6.0f);
  const TrackResult result = tracker.TrackFrame({1, 1 / 30.0, wall});
  EXPECT_EQ(result.outcome, Outcome::kLost);
  EXPECT_NE(result.message.find("confirms"), std::string::npos);
}

// Whatever a frame holds, the result is finite and the subject is found again afterwards.
TEST(RealtimeScape, SurvivesFramesThatShowNothingSensible) {
  Stage stage;
  DepthImage one_pixel(320, 240), not_numbers(320, 240, std::numeric_limits<float>::quiet_NaN());
  one_pixel(160, 120) = 2.5f;
  const DepthImage frames[] = {DepthImage(320, 240),
                               DepthImage(320, 240, 65.535f),
                               DepthImage(320, 240, std::numeric_limits<float>::infinity()),
                               DepthImage(320, 240, 1e-6f),
                               one_pixel,
                               not_numbers};
  for (const DepthImage& odd : frames) {
    RealtimeScape tracker{Settings{}};
    tracker.Start(stage.body, stage.camera);
    tracker.TrackFrame(stage.Frame(0, 0.0));
    for (int i = 1; i <= 3; ++i) {
      const TrackResult result = tracker.TrackFrame({i, i / 30.0, odd});
      for (const Vector3f& vertex : result.vertices) ASSERT_TRUE(vertex.allFinite());
    }
    TrackResult after;
    for (int i = 4; i < 8; ++i) after = tracker.TrackFrame(stage.Frame(i, 0.0));
    EXPECT_FALSE(IsFailure(after.outcome)) << after.message;
    EXPECT_LT(stage.MeanError(after, 0.0), 0.01);
  }
}

TEST(RealtimeScape, IgnoresPixelsThatAreNoNumbers) {
  Stage stage;
  RealtimeScape with_nan{Settings{}}, without{Settings{}};
  with_nan.Start(stage.body, stage.camera);
  without.Start(stage.body, stage.camera);
  DepthFrame frame = stage.Frame(0, 0.1);
  DepthFrame damaged = frame;
  for (int u = 0; u < 320; u += 2) {
    frame.depth(u, 20) = 0.0f;
    damaged.depth(u, 20) = u % 4 == 0 ? std::numeric_limits<float>::quiet_NaN() : -1.0f;
  }
  EXPECT_EQ(with_nan.TrackFrame(damaged).vertices, without.TrackFrame(frame).vertices);
}

TEST(RealtimeScape, KeepsRotationsRotations) {
  Stage stage;
  RealtimeScape tracker{Settings{}};
  tracker.Start(stage.body, stage.camera);
  TrackResult result;
  for (int i = 0; i < 60; ++i) result = tracker.TrackFrame(stage.Frame(i, 0.5 * std::sin(0.2 * i)));
  for (const Rigidd& bone : result.camera_from_rest) {
    EXPECT_LT((bone.rotation.transpose() * bone.rotation - Matrix3<double>::Identity()).norm(),
              1e-12);
    EXPECT_NEAR(bone.rotation.determinant(), 1.0, 1e-12);
  }
}

TEST(RealtimeScape, GivesTheSameResultTwice) {
  const auto run = [] {
    Stage stage;
    RealtimeScape tracker{Settings{}};
    tracker.Start(stage.body, stage.camera);
    TrackResult result;
    for (int i = 0; i < 10; ++i) result = tracker.TrackFrame(stage.Frame(i, 0.05 * i));
    return result;
  };
  const TrackResult first = run(), second = run();
  EXPECT_EQ(first.vertices, second.vertices);
  EXPECT_EQ(first.iterations, second.iterations);
  for (std::size_t k = 0; k < first.energies.size(); ++k) {
    EXPECT_EQ(first.energies[k].value, second.energies[k].value);
  }
}

TEST(RealtimeScape, RefusesWhatItCannotUse) {
  Stage stage;
  RealtimeScape tracker{Settings{}};
  EXPECT_THROW(tracker.TrackFrame(stage.Frame(0, 0.0)), std::invalid_argument);  // before Start
  BodyModel more_weights = stage.body;
  more_weights.weights.bones[3][0] = 40;
  EXPECT_THROW(tracker.Start(more_weights, stage.camera), std::invalid_argument);
  tracker.Start(stage.body, stage.camera);
  EXPECT_THROW(tracker.TrackFrame({0, 0.0, DepthImage(64, 48)}), std::invalid_argument);
}

TEST(Registry, ReadsAMethodAndNamesWhatItDoesNotKnow) {
  const MethodConfig config = ReadMethodConfig(
      Json::parse(R"({"method": "realtime_scape", "settings": {"joint_weight": 3}})"),
      {"m.json", ""});
  EXPECT_EQ(config.settings.at("joint_weight"), 3.0);
  EXPECT_EQ(config.settings.at("inertia_weight"), 5.0);  // resolved
  EXPECT_NE(MakeTracker(config), nullptr);

  const auto message = [](const char* text) -> std::string {
    try {
      ReadMethodConfig(Json::parse(text), {"m.json", ""});
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "no error";
  };
  std::vector<std::string> names;
  for (const MethodInfo& method : Methods()) names.push_back(method.name);
  EXPECT_EQ(message(R"({"method": "realtime_scap"})"),
            fmt::format("m.json: method: unknown method \"realtime_scap\"; did you mean "
                        "\"realtime_scape\"? known: {}",
                        fmt::join(names, ", ")));
  EXPECT_NE(message(R"({"method": "realtime_scape", "settings": {"join_weight": 3}})")
                .find("m.json: settings.join_weight: unknown key (value 3); did you mean "
                      "\"joint_weight\"?"),
            std::string::npos);
}

}  // namespace
}  // namespace vitruvia::realtime_scape
