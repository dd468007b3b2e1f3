// `vitruvia reproduce`: the list that ships, and a small one that is carried out.
#include <algorithm>
#include <cstdlib>

#include <gmock/gmock.h>

#include "analysis/reproduction_list.h"
#include "core/files.h"
#include "core/pattern.h"
#include "experiments/command_line.h"
#include "experiments/plan/experiment_config.h"
#include "experiments/studies/experiment_kinds.h"
#include "experiments/studies/model_study.h"
#include "experiments/studies/reproduction.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const fs::path kList = kConfigs / "reproduction.json";

// Whether the experiment's files are all in the repository; others need data that users bring.
bool IsSelfContained(const fs::path& file) {
  const std::string text = ReadWholeFile(file);
  return text.find("$VITRUVIA") == std::string::npos && text.find("captured/") == std::string::npos;
}

TEST(ReproductionListFile, HasEveryFigureAndTableOfBothPapersInOrder) {
  const auto list = ReadSettingsFile<ReproductionList>(kList);
  std::vector<std::string> ids, expected;
  for (int i = 1; i <= 17; ++i) expected.push_back("A" + std::to_string(i));
  expected.emplace_back("AT1");
  for (int i = 1; i <= 8; ++i) expected.push_back("B" + std::to_string(i));
  for (const ReproducedFigure& figure : list.figures) {
    if (!figure.id.starts_with("C")) ids.push_back(figure.id);
  }
  EXPECT_EQ(ids, expected);
}

// A misspelt variant would make a test that can never be decided.
TEST(ReproductionListFile, TestsNameContendersThatItsExperimentsHave) {
  const auto list = ReadSettingsFile<ReproductionList>(kList);
  for (const ReproducedFigure& figure : list.figures) {
    std::vector<PlannedRun> runs;
    for (const fs::path& file : figure.experiments) {
      ASSERT_TRUE(fs::exists(file)) << figure.id;
      if (!IsSelfContained(file)) continue;
      for (PlannedRun& run : PlanAnyExperiment(file, {}).runs) runs.push_back(std::move(run));
    }
    const auto has = [&runs](const std::string& contender, const std::vector<std::string>& scenes) {
      return std::any_of(runs.begin(), runs.end(), [&](const PlannedRun& run) {
        const bool in_scenes =
            scenes.empty() || std::any_of(scenes.begin(), scenes.end(), [&](const auto& scene) {
              return MatchesPattern(scene, run.scene);
            });
        return in_scenes && MatchesPattern(contender, run.method + "/" + run.variant);
      });
    };
    if (runs.empty()) continue;  // it wants data that only the user can have
    for (const ClaimTest& test : figure.tests) {
      for (const std::string& contender : {test.of, test.against}) {
        if (contender.empty()) continue;
        EXPECT_TRUE(has(contender, test.scenes)) << figure.id << ": " << contender;
      }
    }
    for (const ShownPictures& shown : figure.pictures)
      EXPECT_TRUE(has(shown.of, shown.scenes)) << figure.id << ": " << shown.of;
  }
}

TEST(ReproductionListFile, IsReadStrictly) {
  const Json list = ReadJsonFile(kList);
  const auto refusal_of = [](const Json& changed) -> std::string {
    try {
      ReadSettings<ReproductionList>(changed, {kList, ""});
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal_of(list), "");
  Json changed = list;
  changed["figures"][0]["captoin"] = "x";
  EXPECT_THAT(refusal_of(changed), HasSubstr("did you mean \"caption\""));
  changed = list;
  changed["figures"][1]["id"] = "A1";
  EXPECT_THAT(refusal_of(changed), HasSubstr("the id \"A1\" stands twice"));
  changed = list;
  changed["figures"][0]["cannot_be_tested"] = "no";
  EXPECT_THAT(refusal_of(changed), HasSubstr("expected either tests or cannot_be_tested"));
  changed = list;
  changed["figures"][0].erase("claim");
  EXPECT_THAT(refusal_of(changed), HasSubstr("without a claim expected neither tests"));
  changed = list;
  changed["figures"][0]["tables"] = {{{"title", "t"}, {"metrics", {"l2_meen_m"}}}};
  EXPECT_THAT(refusal_of(changed), HasSubstr("l2_meen_m"));
  changed = list;
  changed["reductions"][0]["experiment"] = "realtime_scape/fig99.json";
  EXPECT_THAT(refusal_of(changed), HasSubstr("no figure is made from"));
}

Json SmallFigure(const std::string& id, const Json& more) {
  Json figure = {{"id", id},
                 {"place", "Paper A, figure 1"},
                 {"title", "small"},
                 {"caption", "c"},
                 {"published", "nothing"},
                 {"claim", "it tracks"},
                 {"experiments", {"experiment.json"}}};
  figure.merge_patch(more);
  return figure;
}

class Reproduce : public testing::Test {
 protected:
  Reproduce() {
    Json scene = ReadJsonFile(kConfigs / "scenes" / "small.json");
    scene["motion"]["file"] = (kConfigs / "motions" / "arm_wave.json").string();
    scene["frames"] = 6;
    files_.Write("scene.json", scene);
    files_.Write("method.json", {{"method", "realtime_scape"}});
    files_.Write("experiment.json", {{"title", "Test"},
                                     {"scenes", {"scene.json"}},
                                     {"methods", {"method.json"}},
                                     {"picture_frames", {0, 5}},  // the last one is left out
                                     {"seeds", {1, 2}}});
    WriteList(0.10);
  }

  void WriteList(double at_most_m) const {
    const Json test = {{"metric", "joint_error_mean_m"}, {"of", "*"}, {"at_most", at_most_m}};
    const Json untested = {{"cannot_be_tested", "a drawing"}};
    files_.Write(
        "list.json",
        {{"title", "Small"},
         {"reductions",
          {{{"experiment", "experiment.json"}, {"most_frames", 3}, {"why", "enough"}}}},
         {"figures", {SmallFigure("A1", {{"tests", {test}}}), SmallFigure("B2", untested)}}});
  }

  CallResult Call(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"reproduce", files_.File("list.json"), "-o",
                                          files_.File("out")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return CallVitruvia(arguments);
  }

  SmallExperiment files_;
};

TEST_F(Reproduce, CarriesOutAPartWritesThePageAndKeepsWhatIsDone) {
  const CallResult first = Call();
  ASSERT_EQ(first.code, 0) << first.error;
  EXPECT_THAT(first.out, HasSubstr("A1   holds"));
  EXPECT_THAT(first.out, HasSubstr("B2   cannot be tested here  a drawing"));
  const std::string page = ReadWholeFile(files_ / "out/index.html");
  for (const char* words : {"it tracks", "mean joint error: * ≤ 100.00 mm", "A part of experiment",
                            "<b class=\"verdict met\">holds</b>"})
    EXPECT_THAT(page, HasSubstr(words));
  EXPECT_THAT(page, Not(HasSubstr("<img src=\"http")));
  const Json summary = ReadJsonFile(files_ / "out/experiment/summary.json");
  ASSERT_EQ(summary.at("rows").size(), 2u);
  for (const Json& row : summary.at("rows")) EXPECT_EQ(row.at("frames"), 3);

  // A figure that is named twice is shown once; all figures are the whole page.
  EXPECT_THAT(Call({"--only", "A1,A1"}).out, HasSubstr("out/A1.html"));
  EXPECT_THAT(Call({"--only", "B2,A1"}).out, HasSubstr("out/index.html"));

  // With another bound nothing is carried out again, and the verdict is another one.
  const auto stored = fs::last_write_time(files_ / "out/experiment/summary.json");
  WriteList(1e-9);
  const CallResult second = Call();
  EXPECT_EQ(second.code, 0) << second.error;
  EXPECT_THAT(second.out, HasSubstr("A1   does not hold here"));
  EXPECT_THAT(second.error, Not(HasSubstr("run 1/2")));
  EXPECT_GE(fs::last_write_time(files_ / "out/experiment/summary.json"), stored);
}

TEST_F(Reproduce, MakesOnlyTheFiguresThatAreAskedFor) {
  const CallResult listed = Call({"--list"});
  EXPECT_EQ(listed.code, 0) << listed.error;
  EXPECT_THAT(listed.out, HasSubstr("A1   Paper A, figure 1: small"));
  EXPECT_FALSE(fs::exists(files_ / "out"));
  const CallResult unknown = Call({"--only", "A1,B3"});
  EXPECT_EQ(unknown.code, static_cast<int>(ExitCode::kBadConfiguration));
  EXPECT_THAT(unknown.error, HasSubstr("no figure \"B3\""));
  ASSERT_EQ(Call({"--only", "B2"}).code, 0);
  EXPECT_TRUE(fs::exists(files_ / "out/B2.html"));
  EXPECT_FALSE(fs::exists(files_ / "out/index.html"));
}

TEST_F(Reproduce, NamesWhatIsMissingInPlaceOfAFigure) {
  files_.Write("experiment.json", {{"title", "Test"},
                                   {"sequences", {"$VITRUVIA_NO_SUCH_FOLDER/S0"}},
                                   {"methods", {"method.json"}}});
  const CallResult call = Call();
  EXPECT_EQ(call.code, 0) << call.error;
  EXPECT_THAT(call.out, HasSubstr("A1   cannot be tested here"));
  EXPECT_THAT(ReadWholeFile(files_ / "out/index.html"), HasSubstr("VITRUVIA_NO_SUCH_FOLDER"));
}

TEST(ModelStudy, TreesHaveTheirNodesInTheOrderOfParents) {
  const BoneTree bones = TreeOfBones();
  EXPECT_EQ(bones.nodes.size(), 17u);
  EXPECT_EQ(bones.Problem(), "");
  const auto special = std::count_if(bones.nodes.begin(), bones.nodes.end(),
                                     [](const auto& node) { return !node.detail.empty(); });
  EXPECT_EQ(special, 7);
  const BoneTree skeleton = TreeOfSkeleton(
      ReadModelSkeleton(kConfigs / "skeletons" / "human.json", MakeControlBody({}).skeleton));
  EXPECT_EQ(skeleton.Problem(), "");
  EXPECT_EQ(skeleton.nodes.front().name, "pelvis");
  EXPECT_EQ(skeleton.nodes.front().detail, "3 slides, 3 hinges");
}

}  // namespace
}  // namespace vitruvia
