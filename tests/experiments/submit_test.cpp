// `vitruvia submit`: the script that it writes, and a real Slurm of one node that carries it out.
#include <cstdlib>
#include <sys/wait.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.h"
#include "experiments/command_line.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class Submit : public testing::Test {
 protected:
  Submit() {
    Json config = SmallExperiment::Config();
    config["seeds"] = {1, 2, 3};
    files_.Write("seeds.json", config);
  }

  SmallExperiment files_;
};

bool IsInstalled(const std::string& program) {
  const std::string search = "PATH=$PATH:/usr/sbin:/sbin command -v " + program + " >/dev/null";
  return std::system(search.c_str()) == 0;
}

TEST_F(Submit, PrintsAScriptOfOneTaskForEachShard) {
  const CallResult call =
      CallVitruvia({"submit", files_.File("seeds.json"), "-o", files_.File("o'ut"), "--shards", "2",
                    "-j", "4", "--sbatch=--time=10", "--print"});
  ASSERT_EQ(call.code, 0) << call.error;
  EXPECT_THAT(call.out, HasSubstr("#!/bin/sh\n#SBATCH --job-name=vitruvia\n#SBATCH --array=1-2\n"
                                  "#SBATCH --cpus-per-task=4\n"));
  EXPECT_THAT(call.out, HasSubstr("#SBATCH --time=10\nexec '"));
  EXPECT_THAT(call.out,
              HasSubstr("' run '" + files_.File("seeds.json") + "' -o '" + files_.File("o'\\''ut") +
                        "' -j 4 --shard \"$SLURM_ARRAY_TASK_ID/2\"\n"));
  EXPECT_FALSE(fs::exists(files_ / "o'ut"));
  const CallResult many = CallVitruvia({"submit", files_.File("seeds.json"), "--print"});
  EXPECT_THAT(many.out, HasSubstr("--array=1-3\n"));  // no task without a run
  EXPECT_THAT(many.out, Not(HasSubstr(" -o ")));
}

TEST_F(Submit, PathsAreQuotedAsSlurmReadsThem) {
  const std::string folder = files_.File("a \"folder\" 100% #x");
  const CallResult call =
      CallVitruvia({"submit", files_.File("seeds.json"), "-o", folder, "--print"});
  ASSERT_EQ(call.code, 0) << call.error;
  EXPECT_THAT(call.out, HasSubstr("#SBATCH --chdir=\"" + fs::current_path().string() + "\"\n"));
  EXPECT_THAT(call.out,
              HasSubstr("#SBATCH --output=\"" +
                        files_.File("a \\\"folder\\\" 100%% #x/slurm-%A_%a.log") + "\"\n"));
  ExpectRefusal({"submit", files_.File("seeds.json"), "-o", files_.File("a\\b"), "--print"},
                ExitCode::kBadConfiguration, {"expected a path without backslashes"});
}

TEST_F(Submit, WhatCannotBeSubmittedIsRefused) {
  const std::string file = files_.File("seeds.json");
  ExpectRefusal({"submit", files_.File("none.json"), "--print"}, ExitCode::kBadConfiguration,
                {"none.json: cannot be opened"});
  ExpectRefusal({"submit", file, "--shards", "0"}, ExitCode::kBadConfiguration, {"--shards"});
  ExpectRefusal({"submit", file, "--sbatch=time=3", "--print"}, ExitCode::kBadConfiguration,
                {"--sbatch time=3: expected an option of sbatch"});
  const std::string path = std::getenv("PATH");
  setenv("PATH", files_.path().c_str(), 1);
  ExpectRefusal({"submit", file, "-o", files_.File("out")}, ExitCode::kFailedRun,
                {"sbatch: cannot be started: No such file or directory (is Slurm installed?)",
                 "the script is", "submit.sbatch"});
  setenv("PATH", path.c_str(), 1);
}

TEST_F(Submit, ASlurmOfOneNodeCarriesItOutToTheSameResult) {
  for (const char* program : {"sbatch", "squeue", "sinfo", "munged", "slurmctld", "slurmd"}) {
    if (!IsInstalled(program))
      GTEST_SKIP() << program << " is not installed (Debian: slurm-wlm, munge)";
  }
  const TemporaryFolder slurm;
  const std::string folder = "slurm 100% done";
  const std::string command = fmt::format(
      "VITRUVIA_LOCK_DIR={} {}/tests/experiments/one_node_slurm.sh {} {} submit {} -o {} --shards "
      "2 >{} 2>&1",
      slurm.path().string(), VITRUVIA_SOURCE_DIR, (slurm / "s").string(), VITRUVIA_PROGRAM,
      files_.File("seeds.json"), "'" + files_.File(folder) + "'", files_.File("said"));
  const int status = std::system(command.c_str());
  const std::string said = ReadWholeFile(files_ / "said");
  ASSERT_EQ(WEXITSTATUS(status), 0) << said;
  EXPECT_THAT(said, HasSubstr("Submitted batch job"));
  EXPECT_THAT(said, HasSubstr("3 runs in 2 tasks"));
  ASSERT_EQ(CallVitruvia({"run", files_.File("seeds.json"), "-o", files_.File("here")}).code, 0);
  EXPECT_EQ(ResultOf(files_ / folder), ResultOf(files_ / "here"));
  EXPECT_TRUE(fs::exists(files_ / folder / "report.html"));
  int logs = 0;
  for (const auto& entry : fs::directory_iterator(files_ / folder))
    logs += entry.path().extension() == ".log" ? 1 : 0;
  EXPECT_EQ(logs, 2);  // one for each task
}

}  // namespace
}  // namespace vitruvia
