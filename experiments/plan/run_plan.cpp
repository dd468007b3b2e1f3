#include "experiments/plan/run_plan.h"

#include <algorithm>
#include <set>
#include <span>

#include "analysis/swept_settings.h"
#include "config/build_cache.h"
#include "core/error.h"
#include "sequence/sequence_files.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

// Long enough for readable sweeps, short enough for a folder's name.
constexpr std::size_t kLongestRunId = 200;

// What is tracked: a scene file, or the folder of a stored sequence.
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

void TakeScene(const fs::path& scene_file, const VariantSettings& variant, int most_frames,
               RunPlan& run) {
  run.scene = SceneNameOf(scene_file);
  run.scene_settings = ReadScene(scene_file, variant.scene);
  run.scene_settings.seed = run.seed;
  if (most_frames > 0) run.scene_settings.frames = std::min(run.scene_settings.frames, most_frames);
  run.frames = run.scene_settings.frames;
  run.resolved["scene"] = WriteSettings(run.scene_settings);
}

void TakeSequence(const fs::path& folder, const VariantSettings& variant, RunPlan& run) {
  run.sequence = folder.has_filename() ? folder : folder.parent_path();
  run.scene = SequenceNameOf(folder);
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
                const VariantSettings& variant, int seed, const ExperimentSettings& experiment) {
  RunPlan run;
  run.score = experiment.score;
  run.variant = variant.name;
  run.method_name = method_file.stem().string();
  run.seed = seed;
  run.method =
      ReadMethodConfig(Merged(ReadJsonFile(method_file), variant.method), {method_file, ""});
  run.resolved = {{"method", {{"method", run.method.method}, {"settings", run.method.settings}}},
                  {"score", WriteSettings(experiment.score)}};
  if (recording.is_stored) {
    TakeSequence(recording.path, variant, run);
  } else {
    TakeScene(recording.path, variant, experiment.most_frames, run);
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
      RunPlan run = PlanRun(recording, method, variant, seed, settings);
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

// Limit of the number of runs, so that a mistyped number does not make planning endless.
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

void RequirePictureFrames(const ExperimentPlan& plan, const fs::path& file) {
  int frames = 0;
  for (const RunPlan& run : plan.runs) frames = std::max(frames, run.frames);
  for (const int frame : plan.record.picture_frames) {
    if (frame < frames) continue;
    throw ConfigError(fmt::format(
        "{}: picture_frames: no run has a frame {}; expected at most {}, the last frame of the "
        "longest run",
        file.string(), frame, frames - 1));
  }
}

template <class Settings>
Settings ReadResolved(const Json& resolved, const char* key) {
  return ReadSettings<Settings>(resolved.at(key), ResolvedOrigin(key));
}

SubjectRecipe ReadResolvedRecipe(const Json& resolved) {
  return {ReadResolved<LearningSettings>(resolved, "learning"),
          ReadResolved<ScanSettings>(resolved, "scan"),
          ReadResolved<IntrinsicShapeSettings>(resolved, "fit")};
}

// What the sweep changes, and the values without it: those of the first run of the first variant.
std::vector<SweptSetting> SweptSettings(const ExperimentSettings& settings) {
  std::vector<SweptSetting> swept;
  if (settings.sweep.axes.empty()) return swept;
  VariantSettings unswept;
  if (!settings.variants.empty()) unswept = settings.variants.front();
  const auto method = std::find_if(settings.methods.begin(), settings.methods.end(),
                                   [&](const fs::path& file) { return IsAbout(unswept, file); });
  const RunPlan plain =
      PlanRun(RecordingsOf(settings).front(), *method, unswept, settings.seeds.front(), settings);
  for (const SweepAxis& axis : settings.sweep.axes)
    swept.push_back({axis.setting, axis.scale, ValueAt(plain.resolved, axis.setting)});
  return swept;
}

}  // namespace

SceneSettings ReadScene(const fs::path& scene_file, const Json& overrides) {
  return ReadSettings<SceneSettings>(Merged(ReadJsonFile(scene_file), overrides), {scene_file, ""});
}

ExperimentPlan PlanExperiment(const fs::path& experiment_file) {
  return PlanExperiment(ReadSettingsFile<ExperimentSettings>(experiment_file), experiment_file);
}

ExperimentPlan PlanExperiment(const ExperimentSettings& settings, const fs::path& experiment_file) {
  ExperimentPlan plan;
  plan.timed = settings.timed;
  plan.failed_frames_limit = settings.failed_frames_limit;
  plan.record.name = ConfigName(experiment_file);
  plan.record.title = settings.title;
  plan.record.description = settings.description;
  plan.record.picture_frames = settings.picture_frames;
  plan.record.side_by_side = settings.side_by_side;
  plan.record.table_columns = settings.table_columns;
  plan.record.summaries = settings.summaries;
  plan.record.sweep = SweptSettings(settings);
  for (const ExpectationSettings& e : settings.expectations) {
    plan.record.expectations.push_back(e.AsRecorded());
  }
  const std::vector<VariantSettings> variants = Swept(settings.variants, settings.sweep);
  RequireDifferentNames(variants, experiment_file);
  RequireFewEnough(settings, variants.size(), experiment_file);
  for (const Recording& recording : RecordingsOf(settings)) {
    for (const fs::path& method : settings.methods) {
      for (const VariantSettings& variant : variants) {
        if (IsAbout(variant, method)) AddRuns(recording, method, variant, settings, plan.runs);
      }
    }
  }
  RequireDifferentRuns(plan.runs, experiment_file);
  RequirePictureFrames(plan, experiment_file);
  for (const RunPlan& run : plan.runs) plan.record.run_ids.push_back(run.run_id);
  return plan;
}

std::vector<PlannedRun> PlannedRuns(const ExperimentPlan& plan, const WorkFolders& work) {
  std::vector<PlannedRun> runs;
  for (const RunPlan& run : plan.runs) {
    PlannedRun& planned = runs.emplace_back();
    planned.experiment = plan.record.name;
    planned.kind = kTrackingKind;
    planned.run_id = run.run_id;
    planned.key = CacheKey(run.resolved);
    planned.resolved = run.resolved;
    planned.variant = run.variant;
    planned.scene = run.scene;
    planned.method = run.method_name;
    planned.seed = run.seed;
    planned.repeat = run.repeat;
    planned.frames = run.frames;
    planned.timed = plan.timed;
    planned.work = work;
    planned.summaries = plan.record.summaries;
    if (run.sequence.empty()) planned.shares = SequenceOf(run, work.sequences);
  }
  return runs;
}

RunPlan ReadSubjectPlan(const PlannedRun& planned) {
  const Json& resolved = planned.resolved;
  RunPlan run;
  if (resolved.contains("scene"))
    run.scene_settings = ReadResolved<SceneSettings>(resolved, "scene");
  if (resolved.contains("subject_folder"))
    run.subject_folder = resolved["subject_folder"].get<std::string>();
  if (resolved.contains("subject")) run.subject = ReadResolvedRecipe(resolved["subject"]);
  if (resolved.contains("faults"))
    run.faults = ReadResolved<InputFaultSettings>(resolved, "faults");
  return run;
}

RunPlan ReadRunPlan(const PlannedRun& planned) {
  const Json& resolved = planned.resolved;
  RunPlan run = ReadSubjectPlan(planned);
  run.run_id = planned.run_id;
  run.variant = planned.variant;
  run.scene = planned.scene;
  run.method_name = planned.method;
  run.seed = planned.seed;
  run.repeat = planned.repeat;
  run.frames = planned.frames;
  run.resolved = resolved;
  run.method = ReadMethodConfig(resolved.at("method"), ResolvedOrigin("method"));
  run.score = ReadResolved<ScoreSettings>(resolved, "score");
  if (resolved.contains("sequence")) run.sequence = resolved["sequence"].get<std::string>();
  return run;
}

CachedFolder SequenceOf(const RunPlan& run, const fs::path& cache) {
  return {cache, run.scene, WriteSettings(run.scene_settings)};
}

}  // namespace vitruvia
