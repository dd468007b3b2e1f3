#include "core/build_info.h"

#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/files.h"
#include "tests/support/temporary_folder.h"

namespace vitruvia {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;

TEST(BuildInfo, SaysWhatThisBuildIs) {
  const BuildInfo& build = GetBuildInfo();
  EXPECT_THAT(build.version, MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
  EXPECT_THAT(build.commit, MatchesRegex("unknown|[0-9a-f]+(-dirty)?"));
  EXPECT_THAT(build.compiler, StartsWith("g++ 1"));
  EXPECT_THAT(build.build_type, MatchesRegex("Release|RelWithDebInfo|Debug|MinSizeRel"));
  EXPECT_THAT(build.flags, HasSubstr("-ffp-contract=off"));
  EXPECT_THAT(build.build_id, MatchesRegex("[0-9a-f]+"));
  EXPECT_EQ(build.build_id.size(), 40u);  // SHA-1
}

TEST(BuildInfo, NamesAVersionOfEveryLibrary) {
  const std::string& libraries = GetBuildInfo().libraries;
  for (const char* name : {"Eigen 3.", "OpenMesh ", "FLANN 1.", "OSMesa ", "Ceres 2.", "OpenCV 4.",
                           "VTK 9.", "nlohmann_json 3."}) {
    EXPECT_THAT(libraries, HasSubstr(name));
  }
  EXPECT_THAT(libraries, Not(HasSubstr(" ,")));  // a name without a version
}

// The commit that the build would write for sources in that folder.
std::string CommitOf(const std::string& sources, const std::filesystem::path& header) {
  const std::string command =
      fmt::format("{} -DSOURCE_DIR={} -DOUTPUT={} -P {}/cmake/WriteCommit.cmake", VITRUVIA_CMAKE,
                  sources, header.string(), VITRUVIA_SOURCE_DIR);
  EXPECT_EQ(std::system(command.c_str()), 0);
  const std::string text = ReadWholeFile(header);
  const std::size_t begin = text.find('"') + 1;
  return text.substr(begin, text.rfind('"') - begin);
}

TEST(BuildInfo, AnArchiveInsideAnotherRepositoryHasNoCommit) {
  if (std::system("git --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "git is not installed";
  const TemporaryFolder outer;
  const std::string commit = fmt::format(
      "cd {} && git init -q && git -c user.name=a -c user.email=a@b.c commit -q --allow-empty -m x "
      "&& mkdir inner",
      outer.path().string());
  ASSERT_EQ(std::system(commit.c_str()), 0);
  EXPECT_THAT(CommitOf(outer.path().string(), outer / "outer.h"), MatchesRegex("[0-9a-f]+"));
  EXPECT_EQ(CommitOf((outer / "inner").string(), outer / "inner.h"), "unknown");
}

TEST(Provenance, HoldsAllOfIt) {
  const nlohmann::json provenance = Provenance();
  for (const char* key :
       {"version", "commit", "compiler", "build_type", "flags", "libraries", "build_id", "cpu"}) {
    ASSERT_TRUE(provenance.contains(key)) << key;
    EXPECT_FALSE(provenance.at(key).get<std::string>().empty()) << key;
  }
  EXPECT_GE(provenance.at("cpu_threads").get<int>(), 1);
}

TEST(TimedProvenance, SaysHowFastTheMachineIs) {
  nlohmann::json timed = TimedProvenance();
  EXPECT_GT(timed.at("calibration_ms").get<double>(), 0.0);
  timed.erase("calibration_ms");
  EXPECT_EQ(timed, Provenance());
}

}  // namespace
}  // namespace vitruvia
