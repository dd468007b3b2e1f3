// The smallest model that a scene needs.
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "experiments/command_line.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;

class Sufficient : public testing::Test {
 protected:
  Sufficient() {
    Json scene = ReadJsonFile(kConfigs / "scenes" / "small.json");
    scene["motion"]["file"] = (kConfigs / "motions" / "arm_wave.json").string();
    scene["frames"] = 6;
    files_.Write("scene.json", scene);
    files_.Write("method.json", {{"method", "realtime_scape"}});
  }

  CallResult Find(const Json& variants, const std::string& metric) {
    files_.Write("experiment.json", {{"title", "Test"},
                                     {"scenes", {"scene.json"}},
                                     {"methods", {"method.json"}},
                                     {"variants", variants}});
    return CallVitruvia({"sufficient", files_.File("experiment.json"), "--metric", metric, "-o",
                         files_.File("out")});
  }

  SmallExperiment files_;
};

Json Part(const std::string& name, const Json& method_settings) {
  return {{"name", name}, {"method", {{"settings", method_settings}}}};
}

TEST_F(Sufficient, NeverLeavesOutWhatTheErrorNeeds) {
  const CallResult call =
      Find({Part("surface", {{"fit", {{"surface_weight", 0}, {"pair_weight", 0}}}}),
            Part("nothing", {{"stopping", {{"first_frame_iterations", 29}}}})},
           "l2_mean_m");
  ASSERT_EQ(call.code, 0) << call.error;
  const Json result = ReadJsonFile(files_ / "out/sufficient.json");
  EXPECT_DOUBLE_EQ(result.at("full").at("error_ratio").get<double>(), 1.0);
  ASSERT_FALSE(result.at("rounds").empty());
  for (const Json& round : result.at("rounds")) {
    for (const Json& trial : round.at("trials")) {
      EXPECT_EQ(trial.at("is_sufficient"), trial.at("part") == "nothing") << trial;
      EXPECT_EQ(trial.at("error_ratio").get<double>() <= 1.05, trial.at("is_sufficient"));
    }
    EXPECT_NE(round.at("left_out"), "surface");
  }
  for (const Json& part : result.at("left_out")) EXPECT_EQ(part, "nothing");
}

TEST_F(Sufficient, RefusesAnExperimentWithoutPartsAndMetricsThatRunsLack) {
  EXPECT_EQ(Find(Json::array(), "l2_mean_m").code, static_cast<int>(ExitCode::kBadConfiguration));
  EXPECT_EQ(Find({Part("axis", {{"axis_weight", 0}})}, "height").code,
            static_cast<int>(ExitCode::kBadConfiguration));
}

}  // namespace
}  // namespace vitruvia
