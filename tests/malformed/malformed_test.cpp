// A thousand damaged configs and sequences, seeded: each is read or refused with its file named and
// a documented exit code, and none brings the program down.
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
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;

constexpr int kConfigMutations = 600;
constexpr int kSequenceMutations = 400;

std::string MutatedText(std::string text, RandomStream& random) {
  const auto at = static_cast<std::size_t>(random.Index(text.size() + 1));
  switch (random.Index(4)) {
    case 0:
      return text.substr(0, at);
    case 1:
      return text.substr(0, at) + static_cast<char>(random.Index(256)) + text.substr(at);
    case 2:
      return text.substr(0, at) + text.substr(text.size() / 2);
    default:
      for (int i = 0; i < 4 && !text.empty(); ++i) {
        text[random.Index(text.size())] = static_cast<char>(random.Index(256));
      }
      return text;
  }
}

Json Strange(RandomStream& random) {
  static const std::vector<Json> kValues = {nullptr,
                                            true,
                                            -1,
                                            0,
                                            1e300,
                                            -1e300,
                                            1e-300,
                                            9007199254740993,
                                            "",
                                            "NaN",
                                            "../../..",
                                            std::string(5000, 'a'),
                                            Json::array(),
                                            Json::object(),
                                            Json::array({1, "two", nullptr}),
                                            Json{{"x", {{"y", 1}}}}};
  return kValues[random.Index(kValues.size())];
}

// All places of a document, the document itself left out.
void CollectPlaces(const Json& json, const Json::json_pointer& here,
                   std::vector<Json::json_pointer>& places) {
  if (!json.is_structured()) return;
  for (const auto& item : json.items()) {
    const Json::json_pointer place = json.is_array()
                                         ? here / static_cast<std::size_t>(std::stoul(item.key()))
                                         : here / item.key();
    places.push_back(place);
    CollectPlaces(item.value(), place, places);
  }
}

Json MutatedJson(Json json, RandomStream& random) {
  std::vector<Json::json_pointer> places;
  CollectPlaces(json, Json::json_pointer(), places);
  if (places.empty()) return Strange(random);
  const Json::json_pointer place = places[random.Index(places.size())];
  Json& parent = json[place.parent_pointer()];
  const Json value = json[place];
  switch (parent.is_object() ? random.Index(4) : random.Index(2)) {
    case 0:
    case 1:
      json[place] = Strange(random);
      return json;
    case 2:
      parent.erase(place.back());
      return json;
    default:
      parent.erase(place.back());
      parent[place.back() + "x"] = value;
      return json;
  }
}

std::string Mutated(const std::string& text, RandomStream& random) {
  return random.Index(3) == 0 ? MutatedText(text, random)
                              : MutatedJson(Json::parse(text), random)
                                    .dump(2, ' ', false, Json::error_handler_t::replace);
}

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
    const std::string damaged = Mutated(whole, random);
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

TEST(Malformed, SequencesAreReadOrRefused) {
  const TemporaryFolder folder;
  const fs::path whole = folder / "whole", copy = folder / "copy";
  SynthesizeSequence(
      ReadScene(fs::path(VITRUVIA_SOURCE_DIR) / "configs/scenes/small.json", {{"frames", 2}}),
      whole);
  VerifySequence(whole);
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(whole)) {
    if (entry.is_regular_file()) files.push_back(entry.path().lexically_relative(whole));
  }
  std::sort(files.begin(), files.end());
  RandomStream random(1, "malformed/sequences");
  int refused = 0;
  for (int i = 0; i < kSequenceMutations; ++i) {
    fs::remove_all(copy);
    fs::copy(whole, copy, fs::copy_options::recursive);
    const fs::path file = copy / files[random.Index(files.size())];
    const std::string bytes = ReadWholeFile(file);
    const std::string damaged =
        file.extension() == ".json" ? Mutated(bytes, random) : MutatedText(bytes, random);
    WriteWholeFile(file, damaged);
    const std::string problem = Misbehaviour([&] {
      try {
        VerifySequence(copy);
      } catch (const Error& error) {
        ++refused;
        EXPECT_NE(std::string(error.what()).find(copy.string()), std::string::npos)
            << error.what() << " names no file; mutation " << i << " of " << file;
        throw;
      }
    });
    EXPECT_EQ(problem, "") << "mutation " << i << " of " << file;
  }
  EXPECT_GT(refused, kSequenceMutations / 2);
}

}  // namespace
}  // namespace vitruvia
