#include "experiments/studies/shape_study.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <Eigen/Geometry>

#include "config/build_cache.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/timer.h"
#include "geometry/surface_map.h"
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
  Eigen::Matrix3Xd a(3, from.size()), b(3, to.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    a.col(static_cast<Eigen::Index>(i)) = from[i].cast<double>();
    b.col(static_cast<Eigen::Index>(i)) = to[i].cast<double>();
  }
  const Eigen::Matrix4d transform = Eigen::umeyama(a, b, false);
  return Rigidd{transform.topLeftCorner<3, 3>(), transform.topRightCorner<3, 1>()}.Cast<float>();
}

struct ShapeStudy {
  ShapeStudySettings settings;
  LearningSettings learning;
  std::vector<ScanSettings> scans;
  WorkFolders work;
};

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

Json Resolved(const ShapeStudy& study, std::size_t scan) {
  return {{"learning", WriteSettings(study.learning)},
          {"scan", WriteSettings(study.scans[scan])},
          {"fit", WriteSettings(study.settings.fit)}};
}

RunRecord CarryOut(const ShapeStudy& study, std::size_t scan_number, int person_number,
                   const std::string& experiment, const std::string& run_id,
                   const fs::path& run_folder) {
  const LearnedModel model = ObtainLearnedModel(study.learning, study.work.learned);
  const BodyModel truth =
      Refine(Population(study.learning.database.population).Subject(person_number),
             study.learning.database.mesh);
  const std::string person = SubjectName(person_number);
  const ScanResult scan = ScanPerson(study.scans[scan_number], truth);
  const ScannedSurface surface = SurfaceOf(scan.surface.mesh);
  const Stopwatch watch;
  const IntrinsicShape fit = FitIntrinsicShape(model.space, model.tracking_space, surface,
                                               truth.attributes, study.settings.fit);
  const double fit_ms = watch.ElapsedMs();
  const BodyModel fitted = PlacedBody(model.space, fit.theta, truth.attributes.sex);
  const ShapeError error = CompareShapes(fitted, truth);
  WriteSurfaceStrips(run_folder, Strips(person, scan, fit, model, truth, error));

  RunRecord record;
  record.run_id = run_id;
  record.experiment = experiment;
  record.variant = study.settings.scans[scan_number].name;
  record.scene = person;
  record.method = kShapeMethod;
  record.config = WithPortablePaths(Resolved(study, scan_number));
  record.provenance = TimedProvenance();
  record.summary = {
      {"run_id", run_id},
      {"variant", record.variant},
      {"scene", person},
      {"method", kShapeMethod},
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
  return record;
}

std::string RunId(const ShapeStudy& study, std::size_t scan, int person) {
  return fmt::format("{}.s{:03}.{}", study.settings.scans[scan].name, person,
                     SettingsHash(Resolved(study, scan)).substr(0, 8));
}

}  // namespace

void ScanVariant::Describe(Fields& f) {
  f.Text("name", name,
         {.meaning = "name of the variant: letters, digits, . _ -", .required = true});
  f.File("scan", scan, {.meaning = "scan file; its person is replaced", .required = true});
}

void ShapeStudySettings::Describe(Fields& f) {
  f.Text("kind", kind, {.meaning = "intrinsic_shape", .required = true});
  f.Text("title", title, {.meaning = "title of the report", .required = true});
  f.Text("description", description, {.meaning = "what the experiment shows"});
  f.File("learning", learning, {.meaning = "learning file", .required = true});
  f.List("scans", scans, {.meaning = "how people are scanned", .required = true});
  f.Integer(
      "people", people,
      {.meaning = "how many of the held-out people, from the first", .min = 1, .max = 100000});
  f.Section("fit", fit, {.meaning = "how the shape is fitted to the scan"});
  f.List("expectations", expectations, {.meaning = "numbers of the paper to print beside ours"});
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
  const auto study = std::make_shared<ShapeStudy>();
  study->settings = ReadSettingsFile<ShapeStudySettings>(file);
  study->learning = ReadLearningSettings(study->settings.learning);
  study->work = work;
  if (study->settings.people > study->learning.held_out) {
    throw ConfigError(fmt::format("{}: people: {} of {} held-out subjects", file.string(),
                                  study->settings.people, study->learning.held_out));
  }
  for (const ScanVariant& scan : study->settings.scans)
    study->scans.push_back(ReadScanSettings(scan.scan));

  Experiment experiment;
  experiment.record.name = ConfigName(file);
  experiment.record.title = study->settings.title;
  experiment.record.description = study->settings.description;
  for (const ExpectationSettings& e : study->settings.expectations)
    experiment.record.expectations.push_back(e.AsRecorded());
  const int first = study->learning.database.population.subjects - study->learning.held_out;
  for (std::size_t scan = 0; scan < study->scans.size(); ++scan) {
    for (int person = first; person < first + study->settings.people; ++person) {
      const std::string run_id = RunId(*study, scan, person);
      experiment.record.run_ids.push_back(run_id);
      PlannedRun run;
      run.run_id = run_id;
      run.key = CacheKey(Resolved(*study, scan));
      run.carry_out = [study, scan, person, run_id,
                       name = experiment.record.name](const fs::path& folder) {
        return CarryOut(*study, scan, person, name, run_id, folder);
      };
      run.method = kShapeMethod;
      run.variant = study->settings.scans[scan].name;
      experiment.runs.push_back(std::move(run));
    }
  }
  return experiment;
}

}  // namespace vitruvia
