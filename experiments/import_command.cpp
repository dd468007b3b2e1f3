#include "experiments/import_command.h"

#include <memory>

#include <CLI/CLI.hpp>

#include "core/json_settings.h"
#include "experiments/mesh_import.h"

namespace vitruvia {
namespace fs = std::filesystem;

void AddImportCommand(CLI::App& app) {
  struct ImportArguments {
    fs::path config, output;
  };
  auto a = std::make_shared<ImportArguments>();
  CLI::App* import = app.add_subcommand("import", "Make a sequence of somebody else's data");
  import->require_subcommand(1);
  CLI::App* meshes = import->add_subcommand(
      "meshes", "Mesh files, one for each frame: rendered as a depth camera sees them");
  meshes->add_option("CONFIG", a->config, "import config file (experiments/mesh_import.h)")
      ->required();
  meshes->add_option("-o,--output", a->output, "folder of the new sequence")->required();
  meshes->callback([a] {
    ImportMeshSequence(ReadSettingsFile<MeshSequenceSettings>(a->config), a->output);
    fmt::print("{}\n", a->output.string());
  });
}

}  // namespace vitruvia
