#include "experiments/studies/shape_study.h"

#include <algorithm>
#include <cmath>

#include "config/build_cache.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/timer.h"
#include "experiments/studies/held_out_people.h"
#include "experiments/studies/study_plan.h"
#include "geometry/surface_map.h"
#include "math/rigid.h"
#include "math/rigid_fit.h"
#include "math/statistics.h"
#include "records/surface_strips.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kShapeMethod = "intrinsic_shape";

std::vector<float> Distances(const std::vector<Vector3f>& points, const TriangleMesh& surface) {
  const std::vector<SurfacePoint> nearest = ClosestSurfacePoints(points, surface);
  std::vector<float> distances;
  for (std::size_t i = 0; i < points.size(); ++i) {
    distances.push_back(
        (Evaluate(nearest[i], surface.vertices.data(), surface.triangles) - points[i]).norm());
  }
  return distances;
}

// The rigid motion that brings points nearest to their counterparts.
Rigidf Alignment(const std::vector<Vector3f>& from, const std::vector<Vector3f>& to) {
  const auto pair_at = [&](std::size_t i) {
    return PointPair{from[i].cast<double>(), to[i].cast<double>()};
  };
  return FitRigid(from.size(), pair_at).Cast<float>();
}

// The settings of one run.
struct ShapeRun {
  LearningSettings learning;
  ScanSettings scan;
  IntrinsicShapeSettings fit;
};

Json ToJson(const ShapeRun& run) {
  return {{"learning", WriteSettings(run.learning)},
          {"scan", WriteSettings(run.scan)},
          {"fit", WriteSettings(run.fit)}};
}

ShapeRun ReadShapeRun(const Json& resolved) {
  return {ReadSettings<LearningSettings>(resolved.at("learning"), ResolvedOrigin("learning")),
          ReadSettings<ScanSettings>(resolved.at("scan"), ResolvedOrigin("scan")),
          ReadSettings<IntrinsicShapeSettings>(resolved.at("fit"), ResolvedOrigin("fit"))};
}

std::vector<SurfaceStrip> Strips(const std::string& person, const ScanResult& scan,
                                 const IntrinsicShape& fit, const LearnedModel& model,
                                 const BodyModel& truth, const ShapeError& error) {
  const TriangleMesh in_scan{fit.in_scan, model.tracking.triangles};
  const ShownSurface scanned{scan.surface.mesh, SurfaceColor::kTruth, {}};
  const ShownSurface fitted{in_scan, SurfaceColor::kEstimate, {}};
  const ShownSurface errors{
      {error.fitted_vertices, truth.rest.triangles}, SurfaceColor::kError, error.surface_m};
  return {{person,
           fmt::format("surface error: mean {:.2f} mm, maximum {:.1f} mm",
                       1e3 * error.surface_mean_m, 1e3 * error.surface_max_m),
           {{"scan", 0.0, {scanned}},
            {"intrinsic shape", 0.0, {fitted}},
            {"both, overlaid", 0.0, {scanned, fitted}},
            {"error, from the front", 0.0, {errors}},
            {"error, from behind", 180.0, {errors}}}}};
}

Json SummaryOf(const PlannedRun& run, const ScanResult& scan, const IntrinsicShape& fit,
               double fit_ms, const BodyModel& fitted, const BodyModel& truth,
               const ShapeError& error) {
  return {{"run_id", run.run_id},
          {"variant", run.variant},
          {"scene", run.scene},
          {"method", run.method},
          {"surface_mean_m", error.surface_mean_m},
          {"surface_max_m", error.surface_max_m},
          {"vertex_mean_m", error.vertex_mean_m},
          {"joint_error_mean_m", error.joint_mean_m},
          {"height_error_m", std::abs(fitted.attributes.height_m - truth.attributes.height_m)},
          {"weight_error_kg", std::abs(fitted.attributes.weight_kg - truth.attributes.weight_kg)},
          {"scan_to_truth_mean_m", scan.truth->scan_to_truth.mean_m},
          {"scan_to_truth_max_m", scan.truth->scan_to_truth.max_m},
          {"camera_error_max_m", scan.truth->path.translation_max_m},
          {"scan_s", 1e-3 * (scan.fuse_ms + scan.extract_ms)},
          {"fit_ms", fit_ms},
          {"iterations", fit.iterations}};
}

// One person and one way to scan.
PlannedRun Planned(const ShapeRun& settings, const std::string& variant, int person) {
  PlannedRun run;
  run.kind = kShapeKind;
  run.resolved = ToJson(settings);
  run.key = CacheKey(run.resolved);
  run.run_id =
      fmt::format("{}.s{:03}.{}", variant, person, SettingsHash(run.resolved).substr(0, 8));
  run.variant = variant;
  run.scene = SubjectName(person);
  run.method = kShapeMethod;
  run.person = person;
  return run;
}

}  // namespace

void ScanVariant::Describe(Fields& f) {
  f.Text("name", name,
         {.meaning = "name of the variant: letters, digits, . _ -", .required = true});
  f.File("scan", scan,
         {.meaning = "scan file; its person is replaced by each of the people", .required = true});
}

void ShapeStudySettings::Describe(Fields& f) {
  f.Text("kind", kind, {.meaning = "kind of the experiment: intrinsic_shape", .required = true});
  f.Text("title", title, {.meaning = "title of the report", .required = true});
  f.Text("description", description,
         {.meaning = "what the experiment shows, printed at the head of the report"});
  f.File("learning", learning, {.meaning = "learning file", .required = true});
  f.List("scans", scans, {.meaning = "ways in which each person is scanned", .required = true});
  f.Integer(
      "people", people,
      {.meaning = "number of held-out people, counted from the first", .min = 1, .max = 100000});
  f.Section("fit", fit, {.meaning = "how the shape is fitted to the scan"});
  f.List("expectations", expectations,
         {.meaning = "values of the paper that the report prints beside ours"});
}

ShapeError CompareShapes(const BodyModel& fitted, const BodyModel& truth) {
  Require(fitted.rest.vertices.size() == truth.rest.vertices.size(),
          "CompareShapes: {} vertices against {}", fitted.rest.vertices.size(),
          truth.rest.vertices.size());
  const Rigidf truth_from_fitted = Alignment(fitted.rest.vertices, truth.rest.vertices);
  ShapeError error;
  std::vector<double> vertex_m, joint_m;
  for (std::size_t v = 0; v < fitted.rest.vertices.size(); ++v) {
    error.fitted_vertices.push_back(truth_from_fitted * fitted.rest.vertices[v]);
    vertex_m.push_back((error.fitted_vertices[v] - truth.rest.vertices[v]).norm());
  }
  for (int b = 0; b < kBoneCount; ++b) {
    joint_m.push_back(
        (truth_from_fitted.Cast<double>() * fitted.skeleton.joints[b] - truth.skeleton.joints[b])
            .norm());
  }
  error.surface_m = Distances(error.fitted_vertices, truth.rest);
  std::vector<double> both(error.surface_m.begin(), error.surface_m.end());
  for (const float d :
       Distances(truth.rest.vertices, {error.fitted_vertices, fitted.rest.triangles})) {
    both.push_back(d);
  }
  error.surface_mean_m = Mean(both);
  error.surface_max_m = Maximum(both);
  error.vertex_mean_m = Mean(vertex_m);
  error.joint_mean_m = Mean(joint_m);
  return error;
}

Experiment PlanShapeStudy(const fs::path& file, const WorkFolders& work) {
  const auto settings = ReadSettingsFile<ShapeStudySettings>(file);
  const LearningSettings learning = ReadLearningSettings(settings.learning);
  RequireEnoughHeldOut(settings.people, learning, file);
  Experiment experiment = PlanOf(settings, file);
  const int first = learning.database.population.subjects - learning.held_out;
  for (const ScanVariant& variant : settings.scans) {
    const ShapeRun shape_run{learning, ReadScanSettings(variant.scan), settings.fit};
    for (int person = first; person < first + settings.people; ++person) {
      AddRun(Planned(shape_run, variant.name, person), work, experiment);
    }
  }
  return experiment;
}

RunRecord CarryOutShapeRun(const PlannedRun& run, const fs::path& run_folder) {
  const ShapeRun settings = ReadShapeRun(run.resolved);
  const LearnedModel model = ObtainLearnedModel(settings.learning, run.work.learned);
  const BodyModel truth =
      Refine(Population(settings.learning.database.population).Subject(run.person),
             settings.learning.database.mesh);
  const ScanResult scan = ScanPerson(settings.scan, truth);
  const ScannedSurface surface = SurfaceOf(scan.surface.mesh);
  const Stopwatch watch;
  const IntrinsicShape fit =
      FitIntrinsicShape(model.space, model.tracking_space, surface, truth.attributes, settings.fit);
  const double fit_ms = watch.ElapsedMs();
  const BodyModel fitted = PlacedBody(model.space, fit.theta, truth.attributes.sex);
  const ShapeError error = CompareShapes(fitted, truth);
  WriteSurfaceStrips(run_folder, Strips(run.scene, scan, fit, model, truth, error));

  RunRecord record;
  record.run_id = run.run_id;
  record.experiment = run.experiment;
  record.variant = run.variant;
  record.scene = run.scene;
  record.method = run.method;
  record.config = WithPortablePaths(run.resolved);
  record.provenance = TimedProvenance();
  record.summary = SummaryOf(run, scan, fit, fit_ms, fitted, truth, error);
  return record;
}

}  // namespace vitruvia
