// Trackers that search for their first pose (a hundred starts: `vitruvia_bench out/bench starts`).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "methods/registry.h"
#include "support/start_trials.h"

namespace vitruvia {
namespace {

using testing::HasSubstr;

std::unique_ptr<Tracker> Searching(const std::string& method, Json settings = Json::object()) {
  settings["start"] = "search";
  return MakeTracker(ReadMethodConfig({{"method", method}, {"settings", settings}}, {"test", ""}));
}

const StartPerson& Child() {
  static const StartPerson child = StartPeople().back();
  return child;
}

TEST(StartSearch, RealtimeScapeFindsAWalkingChildThatTurnsItsSide) {
  const StartTrial trial{4, 3, 90.0, 1};
  const auto tracker = Searching("realtime_scape");
  const StartResult result = RunStartTrial(trial, Child(), StartPostures()[3], *tracker, 3);
  EXPECT_TRUE(result.found) << result.message;
  EXPECT_FALSE(result.swapped);
  EXPECT_LT(result.first_error_m, 0.05);
}

TEST(StartSearch, DynamicFindsRaisedForearms) {
  const StartTrial trial{4, 5, 0.0, 2};
  const auto tracker =
      Searching("dynamic",
                {{"skeleton", std::string(VITRUVIA_SOURCE_DIR) + "/configs/skeletons/human.json"}});
  const StartResult result = RunStartTrial(trial, Child(), StartPostures()[5], *tracker, 2);
  EXPECT_TRUE(result.found) << result.message;
  EXPECT_FALSE(result.swapped);
  EXPECT_LT(result.first_error_m, 0.05);
}

// A wall is no person: the tracker says so, and tries the next frame again.
TEST(StartSearch, NotFoundIsLostUntilThePersonAppears) {
  for (const char* method : {"realtime_scape", "dynamic"}) {
    Json settings = Json::object();
    if (std::string(method) == "dynamic") {
      settings["skeleton"] = std::string(VITRUVIA_SOURCE_DIR) + "/configs/skeletons/human.json";
    }
    const auto tracker = Searching(method, settings);
    const PinholeCamera camera;
    tracker->Start(Child().subject, camera);
    const DepthFrame wall{0, 0.0, DepthImage(camera.width, camera.height, 2.5f)};
    for (int f = 0; f < 2; ++f) {
      const TrackResult result = tracker->TrackFrame(wall);
      EXPECT_EQ(result.outcome, Outcome::kLost) << method;
      EXPECT_THAT(result.message, HasSubstr("not found: from "));
      EXPECT_EQ(result.vertices.size(), Child().subject.rest.vertices.size());
    }
  }
}

}  // namespace
}  // namespace vitruvia
