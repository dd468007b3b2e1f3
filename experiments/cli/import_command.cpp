#include "experiments/cli/import_command.h"

#include <algorithm>
#include <memory>

#include <CLI/CLI.hpp>

#include "config/json_settings.h"
#include "core/build_info.h"
#include "experiments/cli/motion_check_command.h"
#include "importers/depth_import.h"
#include "importers/eval_import.h"
#include "importers/mesh_import.h"

namespace vitruvia {
namespace fs = std::filesystem;

namespace {

struct ImportArguments {
  fs::path config, output;
  std::vector<fs::path> files;
  int threads = 1;
};

std::string ListedOrNone(const std::vector<std::string>& names) {
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

void ImportEval(const ImportArguments& a) {
  const auto settings =
      a.config.empty() ? EvalImportSettings() : ReadSettingsFile<EvalImportSettings>(a.config);
  const EvalImport imported = ImportEvalSequence(a.files, settings, a.output);
  const PinholeCamera& camera = imported.camera;
  fmt::print("{}\n", a.output.string());
  fmt::print("camera: fx {:.3f}, fy {:.3f}, cx {:.3f}, cy {:.3f}; {} points within {:.2g} px\n",
             camera.fx, camera.fy, camera.cx, camera.cy, imported.points,
             imported.camera_residual_px);
  fmt::print("joints: {}\n", ListedOrNone(imported.joints));
  fmt::print("joints that the skeleton has not: {}\n",
             ListedOrNone(imported.unmatched.only_in_sequence));
  fmt::print("joints of the skeleton that the files have not: {}\n",
             ListedOrNone(imported.unmatched.only_in_skeleton));
  if (settings.subject.empty())
    fmt::print("the sequence has no subject: name one where it is tracked\n");
}

void PrintRoom(const Room& room) {
  if (const auto& floor = room.floor) {
    fmt::print("floor: {:.2f} m under the camera, {:.0f} % of the points, tilted {:.1f} degrees\n",
               floor->height_m, 100.0 * floor->share, floor->TiltDegrees());
  } else {
    fmt::print("floor: none found; nothing was removed for it\n");
  }
  fmt::print("noise of depth: {:.2g} mm at 1 m\n", 1e3 * room.noise_at_1m_m);
}

constexpr std::size_t kPrintedFrames = 10;

void PrintCutout(const DepthImport& imported) {
  const CutoutReport& cut = imported.cut;
  fmt::print("people: {} found, kept {}\n", imported.people,
             fmt::join(imported.chosen.numbers, ", "));
  fmt::print("person: {:.1f} % of the image on average, {:.2f} m² in the median\n",
             100.0 * cut.pixel_share, cut.area_m2);
  fmt::print("frames without the person: {} of {}\n", cut.frames_without_person, cut.frames);
  fmt::print("frames with a jump in area: {}\n", cut.area_jumps);
  for (std::size_t i = 0; i < std::min(cut.unsure.size(), kPrintedFrames); ++i)
    fmt::print("unsure of frame {}: {}\n", cut.unsure[i].frame, cut.unsure[i].why);
  if (cut.unsure.size() > kPrintedFrames)
    fmt::print("unsure of {} more frames: see preview.png and sequence.json\n",
               cut.unsure.size() - kPrintedFrames);
}

void ImportDepth(const ImportArguments& a) {
  const auto settings = ReadSettingsFile<DepthImportSettings>(a.config);
  const DepthImport imported = ImportDepthSequence(settings, a.threads, a.output);
  const PinholeCamera& camera = imported.camera;
  fmt::print("{}\n", a.output.string());
  fmt::print(
      "{} frames of {}×{} pixels, {:.4g} frames/s; fx {:.3f}, fy {:.3f}, cx {:.3f}, cy {:.3f}\n",
      imported.frames, camera.width, camera.height, imported.fps, camera.fx, camera.fy, camera.cx,
      camera.cy);
  if (imported.missing > 0)
    fmt::print("{} frames are missing and stand as empty images\n", imported.missing);
  for (std::size_t i = 0; i < std::min(imported.gaps.size(), kPrintedFrames); ++i)
    fmt::print("missing: {}\n", imported.gaps[i]);
  PrintRoom(imported.room);
  PrintCutout(imported);
  fmt::print("look at {}\n", (a.output / "preview.png").string());
  if (settings.subject.empty())
    fmt::print("the sequence has no subject: name one where it is tracked\n");
}

}  // namespace

void AddImportCommand(CLI::App& app) {
  auto a = std::make_shared<ImportArguments>();
  CLI::App* import = app.add_subcommand(
      "import",
      "Convert recordings or meshes of other programs to a sequence, or check a motion file");
  import->require_subcommand(1);
  CLI::App* meshes = import->add_subcommand(
      "meshes", "Mesh files, one for each frame: rendered as a depth camera sees them");
  meshes->add_option("CONFIG", a->config, "import config file (src/importers/mesh_import.h)")
      ->required();
  meshes->add_option("-o,--output", a->output, "folder of the new sequence")->required();
  meshes->callback([a] {
    ImportMeshSequence(ReadSettingsFile<MeshSequenceSettings>(a->config), a->output);
    fmt::print("{}\n", a->output.string());
  });
  CLI::App* depth = import->add_subcommand(
      "depth", "Images of a depth camera, from which the person is segmented");
  a->threads = GetMachineInfo().threads;
  depth->add_option("CONFIG", a->config, "import config file (vitruvia explain import_depth)")
      ->required();
  depth->add_option("-o,--output", a->output, "folder of the new sequence")->required();
  depth->add_option("--threads", a->threads, "threads; the result is the same for any number")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  depth->callback([a] { ImportDepth(*a); });
  CLI::App* eval = import->add_subcommand(
      "eval", "Stanford EVAL: .bin files of one recording, in order; depth and true joints");
  eval->add_option("FILES", a->files, "seq_<human>_<n>.bin")->required();
  eval->add_option("--config", a->config, "import config file (src/importers/eval_import.h)");
  eval->add_option("-o,--output", a->output, "folder of the new sequence")->required();
  eval->callback([a] { ImportEval(*a); });
  AddMotionCheckCommand(*import);
}

}  // namespace vitruvia
