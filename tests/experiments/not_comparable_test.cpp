// What the papers' data is not at hand for says so in its config, and so in index and report.
#include <gmock/gmock.h>

#include "experiments/command_line.h"
#include "experiments/plan/run_plan.h"

namespace vitruvia {
namespace {
namespace fs = std::filesystem;

const fs::path kShippedConfigs = fs::path(VITRUVIA_SOURCE_DIR) / "configs";

TEST(NotComparable, EntriesOfThePapersWithoutTheirDataGiveTheReason) {
  for (const char* name : {"realtime_scape/fig3", "realtime_scape/fig4", "realtime_scape/fig14",
                           "realtime_scape/table1", "dynamic/fig3", "dynamic/fig4_close",
                           "dynamic/fig4_far", "dynamic/fig5"}) {
    const fs::path file = kShippedConfigs / (std::string(name) + ".json");
    const Json expectations = ReadJsonFile(file).at("expectations");
    int of_paper = 0;
    for (const Json& json : expectations) {
      const auto e = ReadSettings<ExpectationSettings>(json, {file, "expectations"});
      if (!e.source.starts_with("paper")) continue;
      if (e.metric == "height_error_m" || e.metric == "weight_error_kg") continue;  // given, held
      ++of_paper;
      EXPECT_NE(e.not_comparable, "") << name << ": " << e.metric;
    }
    EXPECT_GT(of_paper, 0) << name;
  }
}

TEST(NotComparable, TargetsKeepTheirVerdict) {
  const SmallExperiment files;
  Json config = SmallExperiment::Config();
  config["expectations"] = {
      {{"metric", "l2_mean_m"}, {"at_most", 1.0}, {"not_comparable", "another person"}}};
  files.Write("bad.json", config);
  ExpectRefusal({"run", files.File("bad.json"), "--dry-run"}, ExitCode::kBadConfiguration,
                {"expectations[0]: not_comparable and a target: no verdict would be given"});
}

}  // namespace
}  // namespace vitruvia
