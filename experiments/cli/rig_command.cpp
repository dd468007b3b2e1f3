#include "experiments/cli/rig_command.h"

#include <cmath>
#include <memory>

#include <CLI/CLI.hpp>

#include "config/build_cache.h"
#include "core/error.h"
#include "core/files.h"
#include "core/message.h"
#include "experiments/cli/argument_checks.h"
#include "experiments/cli/known_person.h"
#include "geometry/mesh_io.h"
#include "importers/frame_files.h"
#include "math/statistics.h"
#include "reports/pictures/surface_pictures.h"
#include "subjects/rig.h"
#include "subjects/rig_pictures.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

struct RigArguments {
  fs::path meshes, space, settings, output;
  double unit_m = 1.0;
  PersonOptions person;
};

std::vector<TriangleMesh> ReadMeshes(const fs::path& path, double unit_m) {
  if (!fs::is_directory(path)) return {ReadMesh(path, unit_m)};
  const FrameFiles frames = FindFrameFiles(path, IsMeshFile, {}, ".obj, .ply or .off files");
  if (!frames.warning.empty()) PrintMessage("warning: {}\n", frames.warning);
  std::vector<TriangleMesh> meshes;
  for (const fs::path& file : frames.files) meshes.push_back(ReadMesh(file, unit_m));
  return meshes;
}

// Of the T-pose and some frames.
void WriteSheet(const Rig& rig, const std::vector<TriangleMesh>& meshes, const fs::path& stem) {
  constexpr int kFrames = 6;
  RunPictures pictures;
  MeshView view(kPictureSize, kPictureSize);
  DrawSurfaceStrips(RigStrips(rig, meshes, kFrames), view, pictures);
  WritePictureSheet(DrawingWriter(), stem, pictures);
}

void Print(const Rig& rig) {
  const Registration& first = rig.registrations.front();
  const MutualDistance& d = first.distance;
  fmt::print(
      "registered from {}: surface to body {:.1f} mm, body to surface {:.1f} mm; {:.0f} % of the "
      "surface and {:.0f} % of the body explained; {}\n",
      first.start, 1e3 * d.target_to_body_m, 1e3 * d.body_to_target_m, 100.0 * d.target_explained,
      100.0 * d.body_explained,
      std::isfinite(first.margin)
          ? fmt::format("the second-best pose is {:.0f} % farther", 100.0 * first.margin)
          : "no other pose came near");
  fmt::print("{:.2f} m, {:.1f} kg\n", rig.subject.attributes.height_m,
             rig.subject.attributes.weight_kg);
  if (!rig.cost) return;
  fmt::print("frames {}: RMSE over all vertices: mean {:.2f} mm, max {:.2f} mm\n",
             rig.rmse_m.size(), 1e3 * Mean(rig.rmse_m), 1e3 * Maximum(rig.rmse_m));
  fmt::print(
      "T-pose of frame {}: put back {:.2f} mm off on average, {:.2f} mm at most; volume "
      "{:+.1f} %; {} folded triangles\n",
      rig.reference, 1e3 * rig.cost->reposing_mean_m, 1e3 * rig.cost->reposing_max_m,
      100.0 * rig.cost->volume_change, rig.cost->folded_triangles);
}

// All that registrations depend on.
Json InputsOf(const RigArguments& a, const RigSettings& settings) {
  const auto known = [](const std::optional<double>& value) {
    return value ? Json(*value) : Json();
  };
  return {{"meshes_folder", a.meshes.string()},
          {"unit_m", a.unit_m},
          {"space_folder", a.space.string()},
          {"height_m", known(a.person.height_m)},
          {"weight_kg", known(a.person.weight_kg)},
          {"sex", a.person.sex},
          {"registration", WriteSettings(settings.registration)}};
}

void RigToFolder(const RigArguments& a) {
  const auto settings =
      a.settings.empty() ? RigSettings() : ReadSettingsFile<RigSettings>(a.settings);
  const ShapeSpace space = ReadShapeSpace(a.space);
  Registrar registrar(space, a.person.Known(), settings.registration);
  StagedFolder folder(a.output, "weights.bin");
  const std::vector<TriangleMesh> meshes = ReadMeshes(a.meshes, a.unit_m);
  RegistrationLog log(a.output.string() + ".registrations", CacheKey(InputsOf(a, settings)));
  if (!log.registrations().empty()) {
    PrintMessage("{} of {} frames were registered before and are taken over\n",
                 log.registrations().size(), meshes.size());
  }
  const Rig rig = RigMeshes(meshes, registrar, settings, log);
  WriteBodyModel(folder.path(), rig.subject);
  WriteWholeFile(folder.path() / "rig.json", RigRecord(rig, settings).dump(1) + "\n");
  WriteSheet(rig, meshes, folder.path() / "rig");
  folder.Commit();
  log.Remove();
  Print(rig);
  fmt::print("{}\n", a.output.string());
}

}  // namespace

void AddRigCommand(CLI::App& app) {
  auto a = std::make_shared<RigArguments>();
  CLI::App* command = app.add_subcommand(
      "rig", "Make a subject of a person's mesh in any pose, or of a folder of meshes");
  command
      ->add_option("MESHES", a->meshes,
                   "mesh file, or folder of mesh files, one for each "
                   "frame; y up")
      ->required();
  command->add_option("--space", a->space, "folder of the shape space")->required();
  command->add_option("--unit", a->unit_m, "unit of length of the meshes, m")
      ->check(NumberIn(1e-6, 1e3))
      ->capture_default_str();
  AddPersonOptions(*command, a->person);
  command->add_option("--settings", a->settings,
                      "JSON file of the settings; without it the defaults");
  command->add_option("-o,--output", a->output, "folder of the subject")->required();
  command->callback([a] { RigToFolder(*a); });
}

}  // namespace vitruvia
