#include "experiments/studies/weight_study.h"

#include <algorithm>

#include "config/build_cache.h"
#include "core/build_info.h"
#include "core/error.h"
#include "experiments/studies/held_out_people.h"
#include "experiments/studies/study_plan.h"
#include "learning/skinning/fit_errors.h"
#include "math/rigid.h"
#include "math/statistics.h"
#include "records/surface_strips.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kWeightMethod = "skinning_weights";
constexpr const char* kHeldOut = "held_out";  // the only variant
constexpr float kPictureHeight_m = 1.0f;      // of a pose's middle: poses are drawn side by side

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

// The pictures of `count` poses, evenly spread over all.
std::vector<SurfaceStrip> Strips(const skinning::Examples& examples,
                                 const std::vector<BoneTransforms>& transforms,
                                 const std::vector<std::vector<float>>& errors_m,
                                 const BodyModel& reference, std::size_t count) {
  std::vector<SurfaceStrip> strips;
  const std::size_t shown = std::min(count, examples.poses.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const std::size_t pose = i * examples.poses.size() / shown;
    std::vector<Vector3f> fit;
    SkinLinear(examples.rest, reference.weights, transforms[pose], fit);
    strips.push_back(
        Strip(static_cast<int>(pose), examples.poses[pose], fit, errors_m[pose], reference));
  }
  return strips;
}

RunRecord RecordOf(const PlannedRun& run) {
  RunRecord record;
  record.run_id = run.run_id;
  record.experiment = run.experiment;
  record.variant = run.variant;
  record.scene = run.scene;
  record.method = run.method;
  record.config = WithPortablePaths({{"learning", run.resolved.at("learning")}});
  record.provenance = TimedProvenance();
  record.summary = {{"run_id", run.run_id},
                    {"variant", run.variant},
                    {"scene", run.scene},
                    {"method", run.method}};
  return record;
}

PlannedRun Planned(const LearningSettings& learning, int pictures, int person) {
  PlannedRun run;
  run.kind = kWeightKind;
  run.resolved = {{"learning", WriteSettings(learning)}, {"pictures", pictures}};
  run.key = CacheKey(run.resolved);
  run.run_id = fmt::format("{}.{}.{}", kHeldOut, SubjectName(person),
                           SettingsHash(run.resolved["learning"]).substr(0, 8));
  run.variant = kHeldOut;
  run.scene = SubjectName(person);
  run.method = kWeightMethod;
  run.person = person;
  return run;
}

}  // namespace

void WeightStudySettings::Describe(Fields& f) {
  f.Text("kind", kind, {.meaning = "kind of the experiment: skinning_weights", .required = true});
  f.Text("title", title, {.meaning = "title of the report", .required = true});
  f.Text("description", description,
         {.meaning = "what the experiment shows, printed at the head of the report"});
  f.File("learning", learning, {.meaning = "learning file", .required = true});
  f.Integer(
      "people", people,
      {.meaning = "number of held-out people, counted from the first", .min = 1, .max = 100000});
  f.Integer(
      "picture_poses", picture_poses,
      {.meaning = "number of poses of each person that the report shows", .min = 1, .max = 100});
  f.List("expectations", expectations,
         {.meaning = "values of the paper that the report prints beside ours"});
}

Experiment PlanWeightStudy(const fs::path& file, const WorkFolders& work) {
  const auto settings = ReadSettingsFile<WeightStudySettings>(file);
  const LearningSettings learning = ReadLearningSettings(settings.learning);
  RequireEnoughHeldOut(settings.people, learning, file);
  Experiment experiment = PlanOf(settings, file);
  const int first = learning.database.population.subjects - learning.held_out;
  for (int person = first; person < first + settings.people; ++person) {
    AddRun(Planned(learning, settings.picture_poses, person), work, experiment);
  }
  return experiment;
}

RunRecord CarryOutWeightRun(const PlannedRun& run, const fs::path& run_folder) {
  const auto learning =
      ReadSettings<LearningSettings>(run.resolved.at("learning"), ResolvedOrigin("learning"));
  const LearnedModel model = ObtainLearnedModel(learning, run.work.learned);
  const BodyModel& reference = model.space.reference;
  const ControlBody body = Population(learning.database.population).Subject(run.person);
  const skinning::Examples examples{Refine(body, learning.database.mesh).rest.vertices,
                                    MakePoseExamples(learning.database, run.scene, body).poses};
  const skinning::FittedTransforms fitted =
      skinning::FitTransforms(examples, reference.weights, kBoneCount, learning.weights.threads);
  const auto errors_m = skinning::VertexErrors(examples, reference.weights, fitted.poses);
  WriteSurfaceStrips(run_folder, Strips(examples, fitted.poses, errors_m, reference,
                                        run.resolved.at("pictures").get<std::size_t>()));

  std::vector<double> all;
  for (const auto& pose : errors_m) all.insert(all.end(), pose.begin(), pose.end());
  RunRecord record = RecordOf(run);
  record.summary["poses"] = examples.poses.size();
  record.summary["surface_mean_m"] = Mean(all);
  record.summary["surface_p95_m"] = Quantile(all, 0.95);
  record.summary["surface_max_m"] = Maximum(all);
  record.summary["surface_rmse_m"] = fitted.rmse_m;
  return record;
}

}  // namespace vitruvia
