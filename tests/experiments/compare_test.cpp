#include <gmock/gmock.h>

#include "core/files.h"
#include "experiments/command_line.h"

namespace vitruvia {
namespace {
using testing::HasSubstr;

class Compare : public testing::Test {
 protected:
  void MakeRun(const std::string& folder) const {
    Json experiment = ReadJsonFile(files_ / "experiment.json");
    experiment["variants"] = {
        {{"name", "all"}}, {{"name", "no_axis"}, {"method", {{"settings", {{"axis_weight", 0}}}}}}};
    files_.Write("variants.json", experiment);
    ASSERT_EQ(CallVitruvia({"run", files_.File("variants.json"), "-o", files_.File(folder)}).code,
              static_cast<int>(ExitCode::kSuccess));
  }

  SmallExperiment files_;
};

TEST_F(Compare, PrintsATableAndWritesIt) {
  MakeRun("out");
  const CallResult outcome =
      CallVitruvia({"compare", files_.File("out"), "-o", files_.File("tables/variants.json")});
  ASSERT_EQ(outcome.code, static_cast<int>(ExitCode::kSuccess)) << outcome.error;
  EXPECT_THAT(outcome.out, HasSubstr("mean L2 error / diagonal"));
  EXPECT_THAT(outcome.out, HasSubstr("1 pair  too few pairs"));
  const Json row = ReadJsonFile(files_ / "tables/variants.json").at("rows").at(0);
  EXPECT_EQ(row.at("reference"), "all");
  EXPECT_EQ(row.at("other"), "no_axis");
  EXPECT_EQ(row.at("pairs"), 1);
  EXPECT_TRUE(row.at("interval").at(0).is_null());
  EXPECT_THAT(ReadWholeFile(files_.File("out/report.html")),
              HasSubstr("<h2>Variants against all</h2>"));
}

TEST_F(Compare, TheSameRunsOfTwoFoldersDoNotDiffer) {
  MakeRun("first");
  MakeRun("second");
  const CallResult outcome =
      CallVitruvia({"compare", files_.File("first"), files_.File("second"), "--metric", "l2_mean_m",
                    "-o", files_.File("table.csv")});
  ASSERT_EQ(outcome.code, static_cast<int>(ExitCode::kSuccess)) << outcome.error;
  EXPECT_THAT(outcome.out, HasSubstr("second: all"));
  const std::string table = ReadWholeFile(files_.File("table.csv"));
  EXPECT_THAT(table, HasSubstr("second: method/all\",1,0,"));
  EXPECT_THAT(table, HasSubstr("second: method/no_axis\",1,0,"));
  EXPECT_THAT(table, HasSubstr("second: all\",2,0,"));  // a run of each variant: two pairs
}

TEST_F(Compare, BadInputIsNamed) {
  MakeRun("out");
  const auto refused = [&](const std::vector<std::string>& more, ExitCode code,
                           const std::string& words) {
    std::vector<std::string> arguments = {"compare"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const CallResult outcome = CallVitruvia(arguments);
    EXPECT_EQ(outcome.code, static_cast<int>(code)) << outcome.error;
    EXPECT_THAT(outcome.error, HasSubstr(words));
  };
  const std::string out = files_.File("out");
  refused({}, ExitCode::kBadConfiguration, "EXPERIMENT is required");
  refused({files_.File("nowhere")}, ExitCode::kBadData, "nowhere");
  refused({out, "--reference", "al"}, ExitCode::kBadConfiguration,
          "no variant \"al\"; there are: all, no_axis");
  refused({out, "--metric", "l2_men_m"}, ExitCode::kBadConfiguration,
          "did you mean \"l2_mean_m\"?");
  refused({out, "--metric", "l2_mean_m", "--metric", "l2_mean_m"}, ExitCode::kBadConfiguration,
          "asked for twice");
  refused({out, "--detect", "nan"}, ExitCode::kBadConfiguration, "--detect: expected a number in");
  refused({out, "--detect", "0"}, ExitCode::kBadConfiguration, "got 0");
  refused({out, out, "--reference", "all"}, ExitCode::kBadConfiguration, "got two folders");
  refused({out, "-o", "table.txt"}, ExitCode::kBadConfiguration,
          "ends in .tex, .csv, .md or .json");
}

}  // namespace
}  // namespace vitruvia
