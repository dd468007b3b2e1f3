#include "experiments/plan/experiment_config.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "config/build_cache.h"
#include "core/error.h"
#include "metrics/catalogue.h"
#include "sequence/sequence_files.h"

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

// Long enough for any sweep that a person reads, short enough for a folder's name.
constexpr std::size_t kLongestRunId = 200;

// What runs are made on: a scene file, or the folder of a stored sequence.
struct Recording {
  fs::path path;
  bool is_stored = false;
};

std::vector<Recording> RecordingsOf(const ExperimentSettings& settings) {
  std::vector<Recording> recordings;
  for (const fs::path& scene : settings.scenes) recordings.push_back({scene, false});
  for (const fs::path& sequence : settings.sequences) recordings.push_back({sequence, true});
  return recordings;
}

void TakeScene(const fs::path& scene_file, const VariantSettings& variant, RunPlan& run) {
  run.scene = scene_file.stem().string();
  run.scene_settings = ReadScene(scene_file, variant.scene);
  run.scene_settings.seed = run.seed;
  run.frames = run.scene_settings.frames;
  run.resolved["scene"] = WriteSettings(run.scene_settings);
}

void TakeSequence(const fs::path& folder, const VariantSettings& variant, RunPlan& run) {
  run.sequence = folder.has_filename() ? folder : folder.parent_path();
  run.scene = run.sequence.filename().string();
  if (!IsPlainName(run.scene)) {
    throw ConfigError(fmt::format("{}: expected letters, digits, . _ - only in a sequence's name",
                                  folder.string()));
  }
  if (!variant.scene.empty()) {
    throw ConfigError(fmt::format("{}: a stored sequence is as it is, got overrides of its scene",
                                  folder.string()));
  }
  run.frames = ReadSequenceInfo(SequenceFiles{run.sequence}.Header()).frames;
  run.resolved["sequence"] = run.sequence.string();
}

void TakeSubject(const fs::path& subject, RunPlan& run) {
  if (fs::is_directory(subject)) {
    run.subject_folder = subject;
    run.resolved["subject_folder"] = subject.string();
    return;
  }
  if (!run.sequence.empty()) {
    throw ConfigError(
        fmt::format("{}: expected the folder of a subject (mesh.ply, subject.json, weights.bin): "
                    "the person of a stored sequence cannot be scanned",
                    subject.string()));
  }
  run.subject = ReadSubjectRecipe(subject);
  run.resolved["subject"] = ResolvedRecipe(*run.subject);
}

RunPlan PlanRun(const Recording& recording, const fs::path& method_file,
                const VariantSettings& variant, int seed, const ScoreSettings& score) {
  RunPlan run;
  run.score = score;
  run.variant = variant.name;
  run.method_name = method_file.stem().string();
  run.seed = seed;
  run.method =
      ReadMethodConfig(Merged(ReadJsonFile(method_file), variant.method), {method_file, ""});
  run.resolved = {{"method", {{"method", run.method.method}, {"settings", run.method.settings}}},
                  {"score", WriteSettings(score)}};
  if (recording.is_stored) {
    TakeSequence(recording.path, variant, run);
  } else {
    TakeScene(recording.path, variant, run);
  }
  if (!variant.subject.empty()) TakeSubject(variant.subject, run);
  run.faults = variant.faults;
  if (!run.faults.AreNone()) run.resolved["faults"] = WriteSettings(run.faults);
  return run;
}

void NameRun(RunPlan& run) {
  const std::string hash = SettingsHash(run.resolved).substr(0, 8);
  const std::string repeat = run.repeat > 0 ? fmt::format("r{}.", run.repeat) : "";
  run.run_id = fmt::format("{}.{}.{}.s{}.{}{}", run.variant, run.scene, run.method_name, run.seed,
                           repeat, hash);
  if (run.run_id.size() > kLongestRunId) {
    throw ConfigError(fmt::format("the run's name would have {} letters, expected at most {}: {}",
                                  run.run_id.size(), kLongestRunId, run.run_id));
  }
}

// Every variant at every point of the sweep.
std::vector<VariantSettings> Swept(std::vector<VariantSettings> variants,
                                   const SweepSettings& sweep) {
  if (variants.empty()) variants.emplace_back().name = kDefaultVariant;
  std::vector<VariantSettings> swept;
  for (const VariantSettings& variant : variants) {
    for (const SweepPoint& point : PointsOf(sweep)) {
      swept.push_back(variant);
      swept.back().name += point.label;
      swept.back().scene = Merged(variant.scene, point.scene);
      swept.back().method = Merged(variant.method, point.method);
    }
  }
  return swept;
}

// The runs of one recording, method and variant. Only a synthesised one has a seed.
void AddRuns(const Recording& recording, const fs::path& method, const VariantSettings& variant,
             const ExperimentSettings& settings, std::vector<RunPlan>& runs) {
  const std::size_t seeds = recording.is_stored ? 1 : settings.seeds.size();
  try {
    for (const int seed : std::span(settings.seeds).first(seeds)) {
      RunPlan run = PlanRun(recording, method, variant, seed, settings.score);
      for (int repeat = 1; repeat <= settings.repeats; ++repeat) {
        if (settings.repeats > 1) run.repeat = repeat;
        NameRun(run);
        runs.push_back(run);
      }
    }
  } catch (const ConfigError& error) {
    if (variant.name == kDefaultVariant) throw;
    throw ConfigError(fmt::format("variant \"{}\": {}", variant.name, error.what()));
  }
}

// A mistyped number must not keep a machine busy with planning alone.
constexpr double kMostRuns = 100000;

void RequireFewEnough(const ExperimentSettings& settings, std::size_t variants,
                      const fs::path& file) {
  const double recordings =
      static_cast<double>(settings.scenes.size()) * static_cast<double>(settings.seeds.size()) +
      static_cast<double>(settings.sequences.size());
  const double runs = recordings * static_cast<double>(settings.methods.size()) *
                      static_cast<double>(variants) * settings.repeats;
  if (runs <= kMostRuns) return;
  throw ConfigError(fmt::format("{}: stands for {:g} runs, expected at most {:g}", file.string(),
                                runs, kMostRuns));
}

void RequireDifferentNames(const std::vector<VariantSettings>& variants, const fs::path& file) {
  std::set<std::string> names;
  for (const VariantSettings& variant : variants) {
    if (names.insert(variant.name).second) continue;
    throw ConfigError(fmt::format("{}: the sweep makes two variants of the name {}", file.string(),
                                  variant.name));
  }
}

void RequireDifferentRuns(const std::vector<RunPlan>& runs, const fs::path& file) {
  std::set<std::string> ids;
  for (const RunPlan& run : runs) {
    if (ids.insert(run.run_id).second) continue;
    throw ConfigError(fmt::format("{}: the run {} stands twice: a seed or a file is repeated",
                                  file.string(), run.run_id));
  }
}

}  // namespace

void VariantSettings::Describe(Fields& f) {
  f.Text("name", name,
         {.meaning = "name of the variant: letters, digits, . _ -", .required = true});
  f.Text("description", description, {.meaning = "what the variant is for"});
  f.FreeJson("scene", scene, {.meaning = "overrides of the scene file (JSON merge patch)"});
  f.FreeJson("method", method, {.meaning = "overrides of the method file (JSON merge patch)"});
  f.File("subject", subject,
         {.meaning = "what the tracker knows of the person: a subject file (scanned and fitted as "
                     "it says) or the folder of a subject (mesh.ply, subject.json, weights.bin); "
                     "the sequence's own template without"});
  f.Section("faults", faults, {.meaning = "damage done to what the tracker is handed"});
}

std::string VariantSettings::Problem() const {
  if (!IsPlainName(name))
    return fmt::format("name \"{}\": expected letters, digits, . _ - only", name);
  if (!scene.is_object()) return "scene: expected an object of overrides, got " + scene.dump();
  if (!method.is_object()) return "method: expected an object of overrides, got " + method.dump();
  return "";
}

void ExpectationSettings::Describe(Fields& f) {
  f.Text("metric", metric, {.meaning = "key of a metric (vitruvia explain)", .required = true});
  f.Number("paper", paper, {.meaning = "the value that the paper prints"});
  f.Number("at_most", at_most, {.meaning = "our target"});
  f.Number("at_least", at_least, {.meaning = "our target, where more is better"});
  f.Text("source", source, {.meaning = "where the paper prints it"});
  f.Text("remark", remark, {.meaning = "how the work differs"});
  f.Text("not_comparable", not_comparable,
         {.meaning = "why our number says nothing about the paper's: no verdict is given"});
  f.Texts("scenes", scenes, {.meaning = "names of the scenes that it is about; all if empty"});
}

std::string ExpectationSettings::Problem() const {
  if (std::string problem = UnknownMetricProblem(metric); !problem.empty()) return problem;
  const Better better = FindMetric(metric).better;
  if ((!std::isnan(at_least) && better == Better::kLower) ||
      (!std::isnan(at_most) && better == Better::kHigher)) {
    return fmt::format("metric {}: {}; expected the target as {}", metric, Name(better),
                       better == Better::kLower ? "at_most" : "at_least");
  }
  const bool has_target = !std::isnan(at_most) || !std::isnan(at_least);
  if (has_target && !not_comparable.empty()) {
    return "not_comparable and a target: no verdict would be given; expected two expectations, one "
           "for the paper's number and one for the target";
  }
  if (std::isnan(at_most) || std::isnan(at_least)) return "";
  return fmt::format("at_most {} and at_least {}: expected one of the two", at_most, at_least);
}

Expectation ExpectationSettings::AsRecorded() const {
  return {metric, paper, at_most, source, remark, not_comparable, at_least, scenes};
}

void ExperimentSettings::Describe(Fields& f) {
  f.Text("kind", kind, {.meaning = "tracking"});
  f.Text("title", title, {.meaning = "title of the report", .required = true});
  f.Text("description", description,
         {.meaning = "what the experiment shows, for the report's head"});
  f.Files("scenes", scenes, {.meaning = "scene files"});
  f.Files("sequences", sequences,
          {.meaning = "folders of stored sequences, recorded or imported, beside the scenes"});
  f.Files("methods", methods, {.meaning = "method files", .required = true});
  f.List("variants", variants,
         {.meaning = "named overrides; each is run on every scene with every method"});
  f.Section("sweep", sweep, {.meaning = "settings whose values make variants of the variants"});
  f.Integers("seeds", seeds,
             {.meaning = "seeds of the scenes; the whole grid is carried out with each",
              .min = 0,
              .max = 1e9});
  f.Integer("repeats", repeats,
            {.meaning = "how often each run is carried out: for times, since all else is equal",
             .min = 1,
             .max = 1000});
  f.Flag("timed", timed,
         {.meaning = "true: times are what counts, so nothing else runs beside one of its runs on "
                     "the same machine; false: runs may go in parallel (-j)"});
  f.List("expectations", expectations, {.meaning = "numbers of the paper to print beside ours"});
  f.Integers("picture_frames", picture_frames,
             {.meaning = "frames at which the report shows pictures", .min = 0, .max = 1e9});
  f.Flag(
      "side_by_side", side_by_side,
      {.meaning = "true: at these frames the report also shows all runs of a sequence below each "
                  "other, fronts and backs in two colours, so that jitter and twists show"});
  f.Section("score", score, {.meaning = "what is measured beside the usual"});
}

std::string ExperimentSettings::Problem() const {
  if (scenes.empty() && sequences.empty())
    return "scenes: expected at least one scene file (or sequences: a stored one), got none";
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
  return PlanExperiment(ReadSettingsFile<ExperimentSettings>(experiment_file), experiment_file);
}

ExperimentPlan PlanExperiment(const ExperimentSettings& settings, const fs::path& experiment_file) {
  ExperimentPlan plan;
  plan.timed = settings.timed;
  plan.record.name = ConfigName(experiment_file);
  plan.record.title = settings.title;
  plan.record.description = settings.description;
  plan.record.picture_frames = settings.picture_frames;
  plan.record.side_by_side = settings.side_by_side;
  for (const ExpectationSettings& e : settings.expectations) {
    plan.record.expectations.push_back(e.AsRecorded());
  }
  const std::vector<VariantSettings> variants = Swept(settings.variants, settings.sweep);
  RequireDifferentNames(variants, experiment_file);
  RequireFewEnough(settings, variants.size(), experiment_file);
  for (const Recording& recording : RecordingsOf(settings)) {
    for (const fs::path& method : settings.methods) {
      for (const VariantSettings& variant : variants)
        AddRuns(recording, method, variant, settings, plan.runs);
    }
  }
  RequireDifferentRuns(plan.runs, experiment_file);
  for (const RunPlan& run : plan.runs) plan.record.run_ids.push_back(run.run_id);
  return plan;
}

}  // namespace vitruvia
