// A small sweep by the command line: resumed, in shards and in parallel it gives the same result.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.h"
#include "experiments/command_line.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class SharedSweep : public testing::Test {
 protected:
  SharedSweep() {
    Json config = SmallExperiment::Config();
    config["sweep"] = {
        {"axes", {{{"setting", "method.settings.axis_weight"}, {"values", {0, 1}}}}}};
    config["seeds"] = {1, 2};
    files_.Write("sweep.json", config);
  }

  CallResult Run(const std::string& output, std::vector<std::string> options = {}) const {
    options.insert(options.begin(), {"run", files_.File("sweep.json"), "-o", files_.File(output)});
    return CallVitruvia(options);
  }

  SmallExperiment files_;
};

TEST_F(SharedSweep, ShardsJobsAndOneByOneGiveTheSameResult) {
  const CallResult first = Run("shards", {"--shard", "1/2"});
  ASSERT_EQ(first.code, 0) << first.error;
  EXPECT_THAT(first.out, HasSubstr("2 runs done, 0 kept, 0 failed"));
  EXPECT_THAT(first.out, HasSubstr("2 runs of other shards are not done yet: no report"));
  EXPECT_FALSE(fs::exists(files_ / "shards/report.html"));
  const CallResult second = Run("shards", {"--shard", "2/2"});
  ASSERT_EQ(second.code, 0) << second.error;
  EXPECT_TRUE(fs::exists(files_ / "shards/report.html"));
  ASSERT_EQ(Run("jobs", {"-j", "2"}).code, 0);
  ASSERT_EQ(Run("single").code, 0);
  const Json result = ResultOf(files_ / "single");
  EXPECT_EQ(result.at("rows").size(), 4u);
  EXPECT_EQ(ResultOf(files_ / "shards"), result);
  const Json& variants = result.at("variants");
  EXPECT_EQ(variants.at("reference"), "axis_weight=1");
  ASSERT_EQ(variants.at("rows").size(), 2u);
  EXPECT_EQ(variants["rows"][1]["runs"], 2);
  EXPECT_EQ(variants["rows"][0]["metrics"]["l2_mean_of_diagonal"]["difference"]["pairs"], 1)
      << "two seeds of a scene without noise are one measurement";
  const std::string summary = ReadWholeFile(files_ / "single/summary.json");
  EXPECT_LT(summary.find("\"variants\""), summary.find("\"rows\": [\n    {\n      \"case\""));
  const std::string page = ReadWholeFile(files_ / "single/report.html");
  EXPECT_LT(page.find("<h2>2 variants, 4 runs</h2>"), page.find("id=\"papers\""));
  EXPECT_EQ(ResultOf(files_ / "jobs"), result);
}

TEST_F(SharedSweep, DryRunAndStatusSayHowFarItIsAndWriteNothing) {
  const CallResult before = Run("out", {"--dry-run"});
  ASSERT_EQ(before.code, 0) << before.error;
  EXPECT_THAT(before.out, HasSubstr("missing   unknown  default,axis_weight=0.scene.method.s1."));
  EXPECT_THAT(before.out, HasSubstr("4 runs, 4 to be carried out: time unknown"));
  EXPECT_FALSE(fs::exists(files_ / "out"));

  ASSERT_EQ(Run("out", {"--only", "*.s2.*", "-j", "2"}).code, 0);
  const CallResult half = Run("out", {"--dry-run"});
  EXPECT_THAT(half.out, HasSubstr("4 runs, 2 to be carried out: about "));
  EXPECT_THAT(Run("out", {"--dry-run", "--again"}).out,
              HasSubstr("4 runs, 4 to be carried out: about "));
  const std::vector<std::string> by_file = {"status", files_.File("sweep.json"), "-o",
                                            files_.File("out")};
  const CallResult status = CallVitruvia(by_file);
  EXPECT_EQ(status.code, 0);
  EXPECT_THAT(status.out, HasSubstr("missing  default,axis_weight=0.scene.method.s1."));
  EXPECT_THAT(status.out, HasSubstr("done     default,axis_weight=0.scene.method.s2."));
  EXPECT_THAT(status.out, HasSubstr("4 runs, 2 done, 2 missing"));
  EXPECT_EQ(CallVitruvia({"status", files_.File("out")}).out, status.out);

  // Another file that the runs depend on: all that was done is stale.
  const Json scene = ReadJsonFile(files_ / "scene.json");
  const fs::path motion = files_ / "motion.json";
  fs::copy_file(scene.at("motion").at("file").get<std::string>(), motion);
  Json moved = scene;
  moved["motion"]["file"] = motion.string();
  files_.Write("scene.json", moved);
  ASSERT_EQ(Run("out", {"--only", "*.s2.*", "-j", "2"}).code, 0);
  WriteWholeFile(motion, ReadWholeFile(motion) + "\n");
  EXPECT_THAT(CallVitruvia(by_file).out, HasSubstr("4 runs, 2 stale, 2 missing"));
}

TEST_F(SharedSweep, MisuseIsRefused) {
  const std::string file = files_.File("sweep.json");
  ExpectRefusal({"run", file, "--shard", "3/2"}, ExitCode::kBadConfiguration,
                {"--shard 3/2: expected i/n with 1 ≤ i ≤ n"});
  ExpectRefusal({"run", file, "--only", "x*"}, ExitCode::kBadConfiguration,
                {"--only x*: matches no run id, variant or scene of the 4 runs",
                 "default,axis_weight=0.scene"});
  // As of a script's variable that was never set: not all runs.
  ExpectRefusal({"run", file, "--shard", ""}, ExitCode::kBadConfiguration, {"--shard: expected"});
  ExpectRefusal({"run", file, "--only", ""}, ExitCode::kBadConfiguration, {"--only: expected"});
  ExpectRefusal({"run", file, "-j", "0"}, ExitCode::kBadConfiguration, {"--jobs"});
  ExpectRefusal({"status", files_.File("nowhere.json")}, ExitCode::kBadConfiguration,
                {"nowhere.json: cannot be opened"});
  ExpectRefusal({"status", files_.path().string()}, ExitCode::kBadData, {"plan.json"});
  ExpectRefusal({"status", files_.path().string(), "-o", "x"}, ExitCode::kBadConfiguration,
                {"expected an experiment's folder, or an experiment file and -o DIR"});
}

}  // namespace
}  // namespace vitruvia
