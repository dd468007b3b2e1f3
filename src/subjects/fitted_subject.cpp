#include "subjects/fitted_subject.h"

#include "config/build_cache.h"
#include "config/settings_schema.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/files.h"
#include "core/worker_team.h"
#include "geometry/mesh_io.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

struct RecipeFile {
  fs::path learning, scan;
  IntrinsicShapeSettings fit;

  void Describe(Fields& f) {
    f.File("learning", learning, {.meaning = "learning file", .required = true});
    f.File("scan", scan, {.meaning = "scan file; its person is replaced", .required = true});
    f.Section("fit", fit, {.meaning = "how the shape is fitted to the scan"});
  }
};

Json FitRecord(const FittedSubject& subject) {
  const IntrinsicShape& fit = subject.fit;
  Json coverage = Json::object();
  for (int b = 0; b < kBoneCount; ++b) coverage[std::string(Bones()[b].name)] = fit.coverage[b];
  return {{"theta", std::vector<double>(fit.theta.begin(), fit.theta.end())},
          {"iterations", fit.iterations},
          {"converged", fit.converged},
          {"body_to_scan_mean_m", fit.body_to_scan_mean_m},
          {"scan_to_body_mean_m", fit.scan_to_body_mean_m},
          {"coverage", coverage},
          {"height_m", subject.body.attributes.height_m},
          {"weight_kg", subject.body.attributes.weight_kg}};
}

}  // namespace

SubjectRecipe ReadSubjectRecipe(const fs::path& file) {
  const auto recipe = ReadSettingsFile<RecipeFile>(file);
  return {ReadLearningSettings(recipe.learning), ReadScanSettings(recipe.scan), recipe.fit};
}

void VisitSubjectFile(Fields& fields) { VisitDefaults<RecipeFile>(fields); }

Json ResolvedRecipe(const SubjectRecipe& recipe) {
  return {{"learning", WriteSettings(recipe.learning)},
          {"scan", WriteSettings(recipe.scan)},
          {"fit", WriteSettings(recipe.fit)}};
}

FittedSubject FitSubject(const LearnedModel& model, const TriangleMesh& scan,
                         const BodyAttributes& attributes, const IntrinsicShapeSettings& settings) {
  FittedSubject subject;
  subject.fit =
      FitIntrinsicShape(model.space, model.tracking_space, SurfaceOf(scan), attributes, settings);
  subject.body =
      OnTrackingMesh(PlacedBody(model.space, subject.fit.theta, attributes.sex), model.tracking);
  subject.body.name = "fitted";
  return subject;
}

void WriteFittedSubject(const fs::path& folder, const FittedSubject& subject,
                        const TriangleMesh& scan, const Json& provenance) {
  StagedFolder staged(folder, "weights.bin");
  WriteBodyModel(staged.path(), subject.body);
  WriteMesh(staged.path() / "scan.ply", scan);
  Json record = provenance;
  record["fit"] = FitRecord(subject);
  record["build"] = Provenance();
  WriteWholeFile(staged.path() / "provenance.json", record.dump(2) + "\n");
  staged.Commit();
}

BodyModel ObtainFittedSubject(SubjectRecipe recipe, const SceneSettings& scene,
                              const fs::path& cache) {
  recipe.scan.scene.body = scene.body;
  recipe.scan.scene.truth = scene.truth;
  const Json resolved = ResolvedRecipe(recipe);
  const CachedFolder kept(cache, "subject", resolved);
  kept.GetOrBuild([&](const fs::path& folder) {
    LearnedModel model;
    ScanResult scan;
    // Each is serial in large parts, and neither needs the other.
    WorkerTeam(2).For(2, 1, [&](int work, int) {
      if (work == 0) model = ObtainLearnedModel(recipe.learning, cache);
      if (work == 1) scan = ScanWithoutDistances(recipe.scan);
    });
    Require(scan.truth.has_value(), "ObtainFittedSubject: a scan without a person");
    const FittedSubject subject =
        FitSubject(model, scan.surface.mesh, scan.truth->body.attributes, recipe.fit);
    WriteFittedSubject(folder, subject, scan.surface.mesh,
                       {{"made_by", "vitruvia"}, {"recipe", resolved}});
  });
  return ReadBodyModel(kept.path());
}

}  // namespace vitruvia
