#include "experiments/cli/export_command.h"

#include <memory>

#include <CLI/CLI.hpp>

#include "core/error.h"
#include "core/pattern.h"
#include "records/run_record.h"
#include "reports/export/mesh_export.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

struct ExportArguments {
  fs::path folder;
  std::string only;
  std::vector<int> frames;
};

void Export(const ExportArguments& arguments) {
  int runs = 0;
  for (const std::string& run_id : ReadExperimentRecord(arguments.folder).run_ids) {
    if (!arguments.only.empty() && !MatchesPattern(arguments.only, run_id)) continue;
    const fs::path run_folder = arguments.folder / run_id;
    if (!fs::is_directory(run_folder / "estimate")) continue;
    const int frames =
        ExportMeshes(arguments.folder, run_id, arguments.frames, run_folder / "meshes");
    fmt::print("{}: {} frames\n", (run_folder / "meshes" / "estimate.pvd").string(), frames);
    ++runs;
  }
  if (runs == 0)
    throw DataError(fmt::format("{}: holds no run with an estimate to export{}",
                                arguments.folder.string(),
                                arguments.only.empty() ? "" : " that matches " + arguments.only));
}

}  // namespace

void AddExportCommand(CLI::App& app) {
  auto a = std::make_shared<ExportArguments>();
  CLI::App* command = app.add_subcommand(
      "export", "Write estimated and true surfaces with their errors for ParaView (.vtp, .pvd)");
  command->add_option("DIR", a->folder, "the experiment's folder")->required();
  command->add_option("--only", a->only, "only runs whose id matches this pattern (* ? [abc])");
  command->add_option("--frames", a->frames, "only these frames; without it all");
  command->callback([a] { Export(*a); });
}

}  // namespace vitruvia
