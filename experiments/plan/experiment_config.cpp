#include "experiments/plan/experiment_config.h"

#include <algorithm>
#include <cmath>

#include "config/did_you_mean.h"
#include "core/error.h"
#include "core/pattern.h"
#include "experiments/plan/overrides.h"
#include "metrics/catalogue.h"
#include "scoring/summaries.h"

namespace vitruvia {
namespace fs = std::filesystem;

std::string SceneNameOf(const fs::path& scene_file) { return scene_file.stem().string(); }

std::string SequenceNameOf(const fs::path& folder) {
  return (folder.has_filename() ? folder : folder.parent_path()).filename().string();
}

bool IsPlainName(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
  });
}

void VariantSettings::Describe(Fields& f) {
  f.Text("name", name,
         {.meaning = "name of the variant: letters, digits, . _ -", .required = true});
  f.Text("description", description,
         {.meaning = "what the variant shows, for readers of the config"});
  f.Texts("methods", methods,
          {.meaning = "patterns (* ? [abc]) of the names of the method files that the variant is "
                      "about; all if empty"});
  f.FreeJson("scene", scene, {.meaning = "overrides of the scene file (JSON merge patch)"});
  f.FreeJson("method", method, {.meaning = "overrides of the method file (JSON merge patch)"});
  f.File("subject", subject,
         {.meaning = "body model that the tracker is given: a subject file (the person is scanned "
                     "and a shape is fitted) or the folder of a subject (mesh.ply, subject.json, "
                     "weights.bin); without this key the sequence's own template"});
  f.Section("faults", faults, {.meaning = "faults injected into the tracker's input"});
}

std::string VariantSettings::Problem() const {
  if (!IsPlainName(name))
    return fmt::format("name \"{}\": expected letters, digits, . _ - only", name);
  const std::string problem = OverridesProblem("scene", scene);
  return problem.empty() ? OverridesProblem("method", method) : problem;
}

bool IsAbout(const VariantSettings& variant, const fs::path& method_file) {
  return MatchesAny(variant.methods, method_file.stem().string());
}

void ExpectationSettings::Describe(Fields& f) {
  f.Text("metric", metric, {.meaning = "key of a metric (vitruvia explain)", .required = true});
  f.Number("paper", paper, {.meaning = "value of the metric that the paper prints"});
  f.Number("at_most", at_most, {.meaning = "upper bound that our value must meet"});
  f.Number("at_least", at_least, {.meaning = "lower bound that our value must meet"});
  f.Text("source", source, {.meaning = "place in the paper where the value is printed"});
  f.Text("remark", remark, {.meaning = "how our experiment differs from the paper's"});
  f.Text("not_comparable", not_comparable,
         {.meaning = "why our value cannot be compared with the paper's; no verdict is "
                     "given then"});
  f.Texts("scenes", scenes,
          {.meaning = "names of the scenes that the expectation applies to; all if empty"});
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

namespace {

// A variant that applies to none of the methods, or a method without a variant: it would silently
// not be run.
std::string UnusedVariantOrMethod(const ExperimentSettings& settings) {
  for (const VariantSettings& variant : settings.variants) {
    if (std::ranges::none_of(settings.methods,
                             [&](const fs::path& m) { return IsAbout(variant, m); }))
      return fmt::format("variants: \"{}\" is about no method of the experiment: {}", variant.name,
                         fmt::join(variant.methods, ", "));
  }
  for (const fs::path& method : settings.methods) {
    const auto is_about_it = [&](const VariantSettings& v) { return IsAbout(v, method); };
    if (!settings.variants.empty() && std::ranges::none_of(settings.variants, is_about_it))
      return fmt::format("methods: no variant is about {}", method.stem().string());
  }
  return "";
}

std::string Twice(const std::string& key, std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  return twice == names.end() ? "" : fmt::format("{}: the name \"{}\" stands twice", key, *twice);
}

template <class Named>
std::vector<std::string> NamesOf(const std::vector<Named>& all) {
  std::vector<std::string> names;
  for (const Named& named : all) names.push_back(named.name);
  return names;
}

// Of a metric that the experiment shows: it is in the catalogue, and a summary is one of its own.
std::string ShownMetricProblem(const ExperimentSettings& settings, const std::string& key) {
  if (std::string problem = UnknownMetricProblem(key); !problem.empty()) return problem;
  if (FindMetric(key).family != kOwnSummary) return "";
  const std::vector<std::string> defined = NamesOf(settings.summaries);
  const std::string name = FindMetric(key).member;
  if (std::find(defined.begin(), defined.end(), name) != defined.end()) return "";
  return fmt::format("{}: the experiment defines no summary \"{}\"{}", key, name,
                     DidYouMean(name, defined));
}

std::string TableColumnsProblem(const ExperimentSettings& settings) {
  for (const std::string& column : settings.table_columns) {
    if (const std::string problem = ShownMetricProblem(settings, column); !problem.empty())
      return "table_columns: " + problem;
  }
  return Twice("table_columns", settings.table_columns);
}

// An expectation of a scene that is none of the experiment's would never be held against anything.
std::string ExpectationsProblem(const ExperimentSettings& settings) {
  std::vector<std::string> scenes;
  for (const fs::path& scene : settings.scenes) scenes.push_back(SceneNameOf(scene));
  for (const fs::path& sequence : settings.sequences) scenes.push_back(SequenceNameOf(sequence));
  for (std::size_t i = 0; i < settings.expectations.size(); ++i) {
    const ExpectationSettings& expectation = settings.expectations[i];
    std::string problem = ShownMetricProblem(settings, expectation.metric);
    for (const std::string& scene : expectation.scenes) {
      if (std::find(scenes.begin(), scenes.end(), scene) == scenes.end())
        problem =
            fmt::format("the experiment has no scene \"{}\"{}", scene, DidYouMean(scene, scenes));
    }
    if (!problem.empty()) return fmt::format("expectations[{}]: {}", i, problem);
  }
  return "";
}

}  // namespace

void ExperimentSettings::Describe(Fields& f) {
  f.Text("kind", kind, {.meaning = "kind of the experiment: tracking"});
  f.Text("title", title, {.meaning = "title of the report", .required = true});
  f.Text("description", description,
         {.meaning = "what the experiment shows, printed at the head of the report"});
  f.Files("scenes", scenes, {.meaning = "scene files, each synthesised and tracked"});
  f.Files("sequences", sequences,
          {.meaning = "folders of stored sequences, recorded or imported, that are tracked too"});
  f.Files("methods", methods, {.meaning = "method files", .required = true});
  f.List("variants", variants,
         {.meaning = "named overrides; each method tracks each scene with each variant"});
  f.Section("sweep", sweep,
            {.meaning = "settings that take several values; every variant is run with each value"});
  f.Integers(
      "seeds", seeds,
      {.meaning = "seeds of the scenes' random numbers; the whole grid is carried out with each",
       .min = 0,
       .max = 1e9});
  f.Integer("repeats", repeats,
            {.meaning = "number of times that each run is repeated, to measure its time several "
                        "times; all other results are equal",
             .min = 1,
             .max = 1000});
  f.Integer(
      "most_frames", most_frames,
      {.meaning =
           "maximum number of frames of each scene, for quick tests; 0: all frames of the scene",
       .unit = "frames",
       .min = 0,
       .max = 1e6});
  f.Flag("timed", timed,
         {.meaning =
              "true: the experiment measures times, so its runs are executed one by one while no "
              "other run is active on the machine; false: runs may be executed in parallel (-j)"});
  f.Number("failed_frames_limit", failed_frames_limit,
           {.meaning = "largest share of a run's frames that may fail; above it, run and status "
                       "report the failure and end with exit code 8",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.List("expectations", expectations,
         {.meaning = "values of the paper that the report prints beside ours"});
  f.Integers(
      "picture_frames", picture_frames,
      {.meaning = "numbers of the frames that the report shows pictures of; none: four from the "
                  "first to the last",
       .min = 0,
       .max = 1e9});
  f.Texts("table_columns", table_columns,
          {.meaning = "keys of the metrics (vitruvia explain) that the table of variants and plots "
                      "over swept settings show; none: the usual ones"});
  f.Flag("side_by_side", side_by_side,
         {.meaning =
              "true: the report also shows the picture_frames of all runs of a sequence below "
              "each other, the body's front and back in two colours, so that jitter and twisted "
              "limbs can be seen"});
  f.Section("score", score, {.meaning = "metrics that are measured in addition to the usual ones"});
  f.List("summaries", summaries,
         {.meaning = "summaries over the frames of a run; vitruvia rescore FILE computes them of "
                     "runs that were carried out without"});
}

std::string ExperimentSettings::Problem() const {
  if (scenes.empty() && sequences.empty())
    return "scenes: expected at least one scene file (or sequences: a stored one), got none";
  if (methods.empty()) return "methods: expected at least one method file, got none";
  if (seeds.empty()) return "seeds: expected at least one seed, got none";
  for (const FrameSummary& summary : summaries) {
    if (std::string problem = JointsProblem(summary); !problem.empty()) return problem;
  }
  for (const std::string& problem :
       {Twice("summaries", NamesOf(summaries)), Twice("variants", NamesOf(variants)),
        TableColumnsProblem(*this), ExpectationsProblem(*this)}) {
    if (!problem.empty()) return problem;
  }
  return UnusedVariantOrMethod(*this);
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

}  // namespace vitruvia
