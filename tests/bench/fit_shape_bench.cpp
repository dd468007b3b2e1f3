// The offline half of the shape: its space from a population, and a held-out person's fit.
#include "bench/bench.h"
#include "core/random.h"
#include "core/timer.h"
#include "learning/shape/intrinsic_shape.h"
#include "learning/shape/tracking_template.h"
#include "synth/population/make_database.h"

namespace vitruvia::bench {
namespace {

constexpr int kPeople = 60, kHeldOut = 4;
constexpr int kComponents = 30;
constexpr double kScanNoise_m = 0.001;
constexpr int kFitRepeats = 3;

DatabaseSettings People() {
  DatabaseSettings settings;
  settings.population.subjects = kPeople;
  settings.mesh.subdivisions = 3;  // 25,474 vertices: more than the learning mesh of paper A
  settings.subjects_with_poses = 0;
  return settings;
}

ScannedSurface NoisyScan(const TriangleMesh& person) {
  RandomStream random(1, "scan");
  TriangleMesh scan = person;
  for (Vector3f& v : scan.vertices) {
    for (int k = 0; k < 3; ++k) v[k] += static_cast<float>(random.Normal(0.0, kScanNoise_m));
  }
  ScannedSurface surface = SurfaceOf(person);  // normals that noise has not turned over
  surface.points = scan.vertices;
  return surface;
}

}  // namespace

std::vector<Row> FitShape() {
  const BodyDatabase database = MakeDatabase(People());
  std::vector<int> training;
  for (int s = 0; s < kPeople - kHeldOut; ++s) training.push_back(s);
  ShapeSpace space;
  const double learn_ms = MedianMs(
      1, [&] { space = LearnShapeSpace(database, training, {.components = kComponents}); });
  const ShapeSpace tracking = OnTrackingMesh(space, MakeTrackingTemplate(space.reference.rest));
  IntrinsicShapeSettings settings;
  settings.components = kComponents;
  std::vector<double> fit_ms, error_mm;
  for (int s = kPeople - kHeldOut; s < kPeople; ++s) {
    const DatabaseSubject& person = database.subjects[static_cast<std::size_t>(s)];
    const ScannedSurface scan = NoisyScan({person.vertices, database.reference.rest.triangles});
    IntrinsicShape fit;
    fit_ms.push_back(MedianMs(kFitRepeats, [&] {
      fit = FitIntrinsicShape(space, tracking, scan, person.attributes, settings);
    }));
    error_mm.push_back(1000.0 * fit.body_to_scan_mean_m);
  }
  return {{"learn_shape_space_ms", learn_ms, "ms"},
          {"fit_shape_ms", Median(fit_ms), "ms"},
          {"fit_shape_body_to_scan_mm", Median(error_mm), "mm"}};
}

}  // namespace vitruvia::bench
