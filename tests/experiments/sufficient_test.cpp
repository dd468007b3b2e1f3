// The smallest model that a scene needs.
#include "experiments/studies/sufficient.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;
const fs::path kConfigs = fs::path(VITRUVIA_SOURCE_DIR) / "configs";

class Sufficient : public testing::Test {
 protected:
  Sufficient() {
    Json scene = ReadJsonFile(kConfigs / "scenes" / "small.json");
    scene["motion"]["file"] = (kConfigs / "motions" / "arm_wave.json").string();
    scene["frames"] = 6;
    Write("scene.json", scene);
    Write("method.json", {{"method", "realtime_scape"}});
  }

  void Write(const std::string& name, const Json& json) {
    WriteWholeFile(folder_ / name, json.dump());
  }

  Sufficiency Find(const Json& variants, const SufficiencySettings& settings = {}) {
    Write("experiment.json", {{"title", "Test"},
                              {"scenes", {"scene.json"}},
                              {"methods", {"method.json"}},
                              {"variants", variants}});
    return FindSufficient(folder_ / "experiment.json", settings, folder_ / "out", VITRUVIA_PROGRAM);
  }

  TemporaryFolder folder_;
};

Json Part(const std::string& name, const Json& method_settings) {
  return {{"name", name}, {"method", {{"settings", method_settings}}}};
}

TEST_F(Sufficient, NeverLeavesOutWhatTheErrorNeeds) {
  const Sufficiency result =
      Find({Part("surface", {{"fit", {{"surface_weight", 0}, {"pair_weight", 0}}}}),
            Part("nothing", {{"stopping", {{"first_frame_iterations", 29}}}})},
           {.metric = "l2_mean_m"});
  EXPECT_DOUBLE_EQ(result.full.error_ratio, 1.0);
  ASSERT_FALSE(result.rounds.empty());
  for (const SufficiencyRound& round : result.rounds) {
    for (const SufficiencyRound::Trial& trial : round.trials) {
      EXPECT_EQ(trial.is_sufficient, trial.part == "nothing") << trial.part;
      EXPECT_EQ(trial.cost.error_ratio <= 1.05, trial.is_sufficient);
    }
    EXPECT_NE(round.left_out, "surface");
  }
  for (const std::string& part : result.left_out) EXPECT_EQ(part, "nothing");
}

TEST_F(Sufficient, RefusesAnExperimentWithoutPartsAndMetricsThatRunsLack) {
  EXPECT_THROW(Find(Json::array()), ConfigError);
  EXPECT_THROW(Find({Part("axis", {{"axis_weight", 0}})}, {.metric = "height"}), ConfigError);
}

}  // namespace
}  // namespace vitruvia
