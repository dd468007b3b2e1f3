// However the path of an experiment is spelt, and from wherever it is called: the same runs.
#include <gmock/gmock.h>

#include "config/build_cache.h"
#include "core/files.h"
#include "experiments/command_line.h"
#include "experiments/plan/run_plan.h"

namespace vitruvia {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

// Back to where the tests were called from.
class WorkingFolder {
 public:
  explicit WorkingFolder(const fs::path& folder) { fs::current_path(folder); }
  ~WorkingFolder() { fs::current_path(before_); }
  WorkingFolder(const WorkingFolder&) = delete;
  WorkingFolder& operator=(const WorkingFolder&) = delete;

 private:
  fs::path before_ = fs::current_path();
};

class PathSpelling : public testing::Test {
 protected:
  PathSpelling() {
    fs::create_directories(files_ / "configs/scenes");
    Json scene = ReadJsonFile(files_ / "scene.json");
    WriteWholeFile(files_ / "configs/wave.json",
                   ReadWholeFile(scene["motion"]["file"].get<std::string>()));
    scene["motion"]["file"] = "../wave.json";
    scene["frames"] = 2;
    files_.Write("configs/scenes/scene.json", scene);
    files_.Write("configs/method.json", {{"method", "realtime_scape"}});
    files_.Write(
        "configs/x.json",
        {{"title", "Test"}, {"scenes", {"scenes/scene.json"}}, {"methods", {"method.json"}}});
  }

  struct Identity {
    std::string run_id, key, sequence;
    bool operator==(const Identity&) const = default;
  };
  static Identity IdentityOf(const fs::path& experiment) {
    const RunPlan run = PlanExperiment(experiment).runs.at(0);
    const CachedFolder sequence("cache", run.scene, WriteSettings(run.scene_settings));
    return {run.run_id, CacheKey(run.resolved), sequence.path().string()};
  }

  SmallExperiment files_;
};

TEST_F(PathSpelling, IdsKeysAndSequencesAreTheSame) {
  const Identity absolute = IdentityOf(files_ / "configs/x.json");
  {
    const WorkingFolder here(files_.path());
    for (const char* spelling :
         {"configs/x.json", "./configs/x.json", "configs/../configs//x.json"})
      EXPECT_EQ(IdentityOf(spelling), absolute) << spelling;
  }
  const WorkingFolder below(files_ / "configs/scenes");
  EXPECT_EQ(IdentityOf("../x.json"), absolute);
}

TEST_F(PathSpelling, TheSameConfigsElsewhereHaveTheSameIdsAndWhatIsInTheFilesCounts) {
  const Identity before = IdentityOf(files_ / "configs/x.json");
  fs::create_directory(files_ / "elsewhere");
  fs::copy(files_ / "configs", files_ / "elsewhere/configs", fs::copy_options::recursive);
  EXPECT_EQ(IdentityOf(files_ / "elsewhere/configs/x.json"), before);
  WriteWholeFile(files_ / "configs/wave.json", ReadWholeFile(files_ / "configs/wave.json") + "\n");
  const Identity after = IdentityOf(files_ / "configs/x.json");
  EXPECT_EQ(after.run_id, before.run_id);
  EXPECT_NE(after.key, before.key);
}

TEST_F(PathSpelling, OnlyFilesAndFoldersAreRewritten) {
  const std::string file = files_.File("configs/x.json");
  const Json portable = WithPortablePaths({{"title", "a/b"},
                                           {"number", 3},
                                           {"file", file},
                                           {"files", {file, "no such file"}},
                                           {"makehuman_folder", "/data/human"}});
  EXPECT_EQ(portable, Json({{"title", "a/b"},
                            {"number", 3},
                            {"file", "configs/x.json"},
                            {"files", {"configs/x.json", "no such file"}},
                            {"makehuman_folder", "/data/human"}}));
}

TEST_F(PathSpelling, WhatWasDoneUnderOneSpellingIsKeptUnderAnother) {
  const CallResult first =
      CallVitruvia({"run", files_.File("configs/x.json"), "-o", files_.File("out")});
  EXPECT_THAT(first.out, HasSubstr("1 runs done, 0 kept, 0 failed")) << first.error;
  const WorkingFolder here(files_.path());
  for (const char* spelling : {"configs/x.json", "./configs/x.json"}) {
    const CallResult again = CallVitruvia({"run", spelling, "-o", files_.File("out")});
    EXPECT_THAT(again.out, HasSubstr("0 runs done, 1 kept, 0 failed")) << again.error;
  }
}

}  // namespace
}  // namespace vitruvia
