#include "experiments/cli/import_command.h"

#include <memory>

#include <CLI/CLI.hpp>

#include "config/json_settings.h"
#include "experiments/cli/motion_check_command.h"
#include "importers/eval_import.h"
#include "importers/mesh_import.h"

namespace vitruvia {
namespace fs = std::filesystem;

namespace {

struct ImportArguments {
  fs::path config, output;
  std::vector<fs::path> files;
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

}  // namespace

void AddImportCommand(CLI::App& app) {
  auto a = std::make_shared<ImportArguments>();
  CLI::App* import = app.add_subcommand(
      "import",
      "Make a sequence of recordings or meshes of other programs, or check a motion file");
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
  CLI::App* eval = import->add_subcommand(
      "eval", "Stanford EVAL: .bin files of one recording, in their order; depth and true joints");
  eval->add_option("FILES", a->files, "seq_<human>_<n>.bin")->required();
  eval->add_option("--config", a->config, "import config file (src/importers/eval_import.h)");
  eval->add_option("-o,--output", a->output, "folder of the new sequence")->required();
  eval->callback([a] { ImportEval(*a); });
  AddMotionCheckCommand(*import);
}

}  // namespace vitruvia
