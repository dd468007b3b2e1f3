#include "experiments/studies/weight_study.h"

#include <algorithm>
#include <memory>

#include "config/build_cache.h"
#include "core/build_info.h"
#include "core/error.h"
#include "learning/skinning/fit_errors.h"
#include "math/statistics.h"
#include "records/surface_strips.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kWeightMethod = "skinning_weights";
constexpr float kPictureHeight_m = 1.0f;  // of a pose's middle: poses are drawn side by side

struct WeightStudy {
  WeightStudySettings settings;
  LearningSettings learning;
  WorkFolders work;
};

std::vector<Vector3f> Centred(std::vector<Vector3f> vertices) {
  Vector3d mean = Vector3d::Zero();
  for (const Vector3f& v : vertices)
    mean += v.cast<double>() / static_cast<double>(vertices.size());
  const Vector3f shift = Vector3f(0.0f, kPictureHeight_m, 0.0f) - mean.cast<float>();
  for (Vector3f& v : vertices) v += shift;
  return vertices;
}

SurfaceStrip Strip(int pose, const std::vector<Vector3f>& truth, const std::vector<Vector3f>& fit,
                   const std::vector<float>& errors_m, const BodyModel& reference) {
  const std::vector<Triangle>& triangles = reference.rest.triangles;
  const ShownSurface shown_truth{{Centred(truth), triangles}, SurfaceColor::kTruth, {}};
  const ShownSurface shown_fit{{Centred(fit), triangles}, SurfaceColor::kEstimate, {}};
  ShownSurface bones = shown_fit, errors = shown_fit;
  bones.color = SurfaceColor::kBone;
  for (const auto& heaviest : reference.weights.bones) bones.values.push_back(heaviest[0]);
  errors.color = SurfaceColor::kError;
  errors.values = errors_m;
  const std::vector<double> all(errors_m.begin(), errors_m.end());
  return {
      fmt::format("pose {}", pose),
      fmt::format("error: mean {:.2f} mm, maximum {:.1f} mm", 1e3 * Mean(all), 1e3 * Maximum(all)),
      {{"example", 0.0, {shown_truth}},
       {"linear blend skinning", 0.0, {shown_fit}},
       {"heaviest bone", 0.0, {bones}},
       {"error, from the front", 0.0, {errors}},
       {"error, from behind", 180.0, {errors}}}};
}

RunRecord CarryOut(const WeightStudy& study, int person_number, const std::string& experiment,
                   const std::string& run_id, const fs::path& run_folder) {
  const LearnedModel model = ObtainLearnedModel(study.learning, study.work.learned);
  const BodyModel& reference = model.space.reference;
  const std::string person = SubjectName(person_number);
  const ControlBody body = Population(study.learning.database.population).Subject(person_number);
  const skinning::Examples examples{Refine(body, study.learning.database.mesh).rest.vertices,
                                    MakePoseExamples(study.learning.database, person, body).poses};
  const skinning::FittedTransforms fitted = skinning::FitTransforms(
      examples, reference.weights, kBoneCount, study.learning.weights.threads);
  const auto errors_m = skinning::VertexErrors(examples, reference.weights, fitted.poses);

  std::vector<double> all;
  for (const auto& pose : errors_m) all.insert(all.end(), pose.begin(), pose.end());
  std::vector<SurfaceStrip> strips;
  const auto shown = std::min<std::size_t>(study.settings.picture_poses, examples.poses.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const std::size_t pose = i * examples.poses.size() / shown;
    std::vector<Vector3f> fit;
    SkinLinear(examples.rest, reference.weights, fitted.poses[pose], fit);
    strips.push_back(
        Strip(static_cast<int>(pose), examples.poses[pose], fit, errors_m[pose], reference));
  }
  WriteSurfaceStrips(run_folder, strips);

  RunRecord record;
  record.run_id = run_id;
  record.experiment = experiment;
  record.variant = "held_out";
  record.scene = person;
  record.method = kWeightMethod;
  record.config = WithPortablePaths({{"learning", WriteSettings(study.learning)}});
  record.provenance = TimedProvenance();
  record.summary = {{"run_id", run_id},
                    {"variant", record.variant},
                    {"scene", person},
                    {"method", kWeightMethod},
                    {"poses", examples.poses.size()},
                    {"surface_mean_m", Mean(all)},
                    {"surface_p95_m", Quantile(all, 0.95)},
                    {"surface_max_m", Maximum(all)},
                    {"surface_rmse_m", fitted.rmse_m}};
  return record;
}

}  // namespace

void WeightStudySettings::Describe(Fields& f) {
  f.Text("kind", kind, {.meaning = "skinning_weights", .required = true});
  f.Text("title", title, {.meaning = "title of the report", .required = true});
  f.Text("description", description, {.meaning = "what the experiment shows"});
  f.File("learning", learning, {.meaning = "learning file", .required = true});
  f.Integer(
      "people", people,
      {.meaning = "how many of the held-out people, from the first", .min = 1, .max = 100000});
  f.Integer("picture_poses", picture_poses,
            {.meaning = "how many poses of each person the report shows", .min = 1, .max = 100});
  f.List("expectations", expectations, {.meaning = "numbers of the paper to print beside ours"});
}

Experiment PlanWeightStudy(const fs::path& file, const WorkFolders& work) {
  const auto study = std::make_shared<WeightStudy>();
  study->settings = ReadSettingsFile<WeightStudySettings>(file);
  study->learning = ReadLearningSettings(study->settings.learning);
  study->work = work;
  if (study->settings.people > study->learning.held_out) {
    throw ConfigError(fmt::format("{}: people: {} of {} held-out subjects", file.string(),
                                  study->settings.people, study->learning.held_out));
  }
  Experiment experiment;
  experiment.record.name = ConfigName(file);
  experiment.record.title = study->settings.title;
  experiment.record.description = study->settings.description;
  for (const ExpectationSettings& e : study->settings.expectations)
    experiment.record.expectations.push_back(e.AsRecorded());
  const Json resolved = WriteSettings(study->learning);
  const std::string hash = SettingsHash(resolved).substr(0, 8);
  const int first = study->learning.database.population.subjects - study->learning.held_out;
  for (int person = first; person < first + study->settings.people; ++person) {
    const std::string run_id = fmt::format("held_out.{}.{}", SubjectName(person), hash);
    experiment.record.run_ids.push_back(run_id);
    PlannedRun run;
    run.run_id = run_id;
    run.key = CacheKey({{"learning", resolved}, {"pictures", study->settings.picture_poses}});
    run.carry_out = [study, person, run_id, name = experiment.record.name](const fs::path& folder) {
      return CarryOut(*study, person, name, run_id, folder);
    };
    run.method = kWeightMethod;
    experiment.runs.push_back(std::move(run));
  }
  return experiment;
}

}  // namespace vitruvia
