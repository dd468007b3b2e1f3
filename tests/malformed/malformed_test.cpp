// Hundreds of damaged configs, seeded: each is read or refused with a documented exit code, and
// none brings the program down. What other files come to is tested in tests/fuzz.
#include <gtest/gtest.h>

#include "config/json_settings.h"
#include "core/error.h"
#include "core/files.h"
#include "core/random.h"
#include "experiments/plan/run_plan.h"
#include "experiments/studies/experiment_kinds.h"
#include "methods/dynamic/skeleton_file.h"
#include "subjects/learned_model.h"
#include "subjects/scan.h"
#include "support/mutation.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;

constexpr int kConfigMutations = 600;

void ReadConfig(const fs::path& file, const std::string& kind, const fs::path& work) {
  if (kind == "scenes") {
    ReadScene(file);
  } else if (kind == "methods") {
    ReadMethodConfig(ReadJsonFile(file), {file, ""});
  } else if (kind == "scans") {
    ReadScanSettings(file);
  } else if (kind == "learning") {
    ReadLearningSettings(file);
  } else if (kind == "subjects") {
    ReadSubjectRecipe(file);
  } else if (kind == "skeletons") {
    dynamic::ReadSkeletonFile(file);
  } else {
    PlanAnyExperiment(file, {work / "sequences", work / "learned"});
  }
}

// "" if `attempt` went through or refused what it got as it should.
template <class Attempt>
std::string Misbehaviour(const Attempt& attempt) {
  try {
    attempt();
  } catch (const Error& error) {
    const bool documented =
        error.code() == ExitCode::kBadConfiguration || error.code() == ExitCode::kBadData;
    if (!documented) return fmt::format("exit code {}: {}", int(error.code()), error.what());
    if (std::string(error.what()).empty()) return "a refusal without a word";
  } catch (const std::exception& error) {
    return fmt::format("no error of ours: {}", error.what());
  }
  return "";
}

TEST(Malformed, ConfigsAreReadOrRefused) {
  const TemporaryFolder folder;
  const fs::path configs = folder / "configs";
  fs::copy(fs::path(VITRUVIA_SOURCE_DIR) / "configs", configs, fs::copy_options::recursive);
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(configs)) {
    const bool is_motion = entry.path().parent_path().filename() == "motions";  // read by synth
    if (entry.path().extension() == ".json" && !is_motion) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  RandomStream random(1, "malformed/configs");
  int refused = 0;
  for (int i = 0; i < kConfigMutations; ++i) {
    const fs::path& file = files[random.Index(files.size())];
    const std::string whole = ReadWholeFile(file);
    const std::string damaged = MutateJson(whole, {}, random).content;
    WriteWholeFile(file, damaged);
    const std::string kind = file.lexically_relative(configs).begin()->string();
    const std::string problem = Misbehaviour([&] {
      try {
        ReadConfig(file, kind, folder.path());
      } catch (const Error&) {
        ++refused;
        throw;
      }
    });
    EXPECT_EQ(problem, "") << "mutation " << i << " of " << file.filename() << ":\n" << damaged;
    WriteWholeFile(file, whole);
  }
  EXPECT_GT(refused, kConfigMutations / 2);  // most damage is noticed; free text may change
  EXPECT_FALSE(fs::exists(folder / "out"));  // planning writes nothing
}

}  // namespace
}  // namespace vitruvia
