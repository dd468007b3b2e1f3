#include "experiments/experiment_config.h"

#include <algorithm>

#include "core/error.h"
#include "core/hash.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kDefaultVariant = "default";

// Names become parts of folder names.
bool IsPlainName(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
  });
}

RunPlan PlanRun(const fs::path& scene_file, const fs::path& method_file,
                const VariantSettings& variant, int seed) {
  RunPlan run;
  run.variant = variant.name;
  run.scene = scene_file.stem().string();
  run.method_name = method_file.stem().string();
  run.seed = seed;
  run.scene_settings = ReadScene(scene_file, variant.scene);
  run.scene_settings.seed = seed;
  run.method =
      ReadMethodConfig(Merged(ReadJsonFile(method_file), variant.method), {method_file, ""});
  run.resolved = {{"scene", WriteSettings(run.scene_settings)},
                  {"method", {{"method", run.method.method}, {"settings", run.method.settings}}}};
  if (!variant.subject.empty()) {
    run.subject = ReadSubjectRecipe(variant.subject);
    run.resolved["subject"] = ResolvedRecipe(*run.subject);
  }
  const std::string hash = Hash64().Add(run.resolved.dump()).Hex().substr(0, 8);
  run.run_id = fmt::format("{}.{}.{}.s{}.{}", run.variant, run.scene, run.method_name, seed, hash);
  return run;
}

}  // namespace

void VariantSettings::Describe(Fields& f) {
  f.Text("name", name,
         {.meaning = "name of the variant: letters, digits, . _ -", .required = true});
  f.Text("description", description, {.meaning = "what the variant is for"});
  f.FreeJson("scene", scene, {.meaning = "overrides of the scene file (JSON merge patch)"});
  f.FreeJson("method", method, {.meaning = "overrides of the method file (JSON merge patch)"});
  f.File("subject", subject,
         {.meaning = "subject file: the tracker's subject is scanned and fitted as it says; the "
                     "scene's own template without"});
}

std::string VariantSettings::Problem() const {
  if (!IsPlainName(name))
    return fmt::format("name \"{}\": expected letters, digits, . _ - only", name);
  if (!scene.is_object()) return "scene: expected an object of overrides, got " + scene.dump();
  if (!method.is_object()) return "method: expected an object of overrides, got " + method.dump();
  return "";
}

void ExpectationSettings::Describe(Fields& f) {
  f.Text("metric", metric, {.meaning = "a key of the summary rows", .required = true});
  f.Number("paper", paper, {.meaning = "the value that the paper prints"});
  f.Number("at_most", at_most, {.meaning = "our target"});
  f.Text("source", source, {.meaning = "where the paper prints it"});
  f.Text("remark", remark, {.meaning = "how the work differs"});
  f.Text("not_comparable", not_comparable,
         {.meaning = "why our number says nothing about the paper's: no verdict is given"});
}

void ExperimentSettings::Describe(Fields& f) {
  f.Text("kind", kind, {.meaning = "tracking"});
  f.Text("title", title, {.meaning = "title of the report", .required = true});
  f.Text("description", description,
         {.meaning = "what the experiment shows, for the report's head"});
  f.Files("scenes", scenes, {.meaning = "scene files", .required = true});
  f.Files("methods", methods, {.meaning = "method files", .required = true});
  f.List("variants", variants,
         {.meaning = "named overrides; each is run on every scene with every method"});
  f.Integers("seeds", seeds,
             {.meaning = "seeds; each is a repeat of the whole grid", .min = 0, .max = 1e9});
  f.List("expectations", expectations, {.meaning = "numbers of the paper to print beside ours"});
  f.Integers("picture_frames", picture_frames,
             {.meaning = "frames at which the report shows pictures", .min = 0, .max = 1e9});
}

std::string ExperimentSettings::Problem() const {
  if (scenes.empty()) return "scenes: expected at least one scene file, got none";
  if (methods.empty()) return "methods: expected at least one method file, got none";
  if (seeds.empty()) return "seeds: expected at least one seed, got none";
  std::vector<std::string> names;
  for (const VariantSettings& variant : variants) {
    if (std::find(names.begin(), names.end(), variant.name) != names.end()) {
      return fmt::format("variants: the name \"{}\" stands twice", variant.name);
    }
    names.push_back(variant.name);
  }
  return "";
}

std::string ConfigName(const fs::path& file) {
  const fs::path absolute = fs::absolute(file).lexically_normal();
  fs::path below;
  bool found = false;
  for (const fs::path& part : absolute) {
    if (part == "configs") {
      below.clear();
      found = true;
    } else {
      below /= part;
    }
  }
  return (found ? below : absolute.filename()).replace_extension().generic_string();
}

SceneSettings ReadScene(const fs::path& scene_file, const Json& overrides) {
  return ReadSettings<SceneSettings>(Merged(ReadJsonFile(scene_file), overrides), {scene_file, ""});
}

ExperimentPlan PlanExperiment(const fs::path& experiment_file) {
  auto settings = ReadSettingsFile<ExperimentSettings>(experiment_file);
  if (settings.variants.empty()) settings.variants.emplace_back().name = kDefaultVariant;

  ExperimentPlan plan;
  plan.record.name = ConfigName(experiment_file);
  plan.record.title = settings.title;
  plan.record.description = settings.description;
  plan.record.picture_frames = settings.picture_frames;
  for (const ExpectationSettings& e : settings.expectations) {
    plan.record.expectations.push_back(
        {e.metric, e.paper, e.at_most, e.source, e.remark, e.not_comparable});
  }
  for (const fs::path& scene : settings.scenes) {
    for (const fs::path& method : settings.methods) {
      for (const VariantSettings& variant : settings.variants) {
        for (const int seed : settings.seeds) {
          plan.runs.push_back(PlanRun(scene, method, variant, seed));
          plan.record.run_ids.push_back(plan.runs.back().run_id);
        }
      }
    }
  }
  return plan;
}

}  // namespace vitruvia
