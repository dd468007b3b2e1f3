#include "experiments/cli/export_command.h"

#include <map>
#include <memory>

#include <CLI/CLI.hpp>

#include "core/error.h"
#include "experiments/cli/experiment_folder.h"
#include "experiments/cli/problems.h"
#include "experiments/run/tracking_run.h"
#include "records/run_record.h"
#include "reports/export/gltf_export.h"
#include "reports/export/joint_export.h"
#include "reports/export/mesh_export.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

enum class Format { kVtp, kGlb, kBvh, kCsv };

const std::map<std::string, Format> kFormats = {
    {"vtp", Format::kVtp}, {"glb", Format::kGlb}, {"bvh", Format::kBvh}, {"csv", Format::kCsv}};

struct ExportArguments {
  fs::path folder;
  std::string only;
  std::vector<int> frames;
  std::vector<Format> formats{Format::kVtp};
};

// Returns what to open, and how many frames are in it.
std::pair<fs::path, int> ExportRun(const fs::path& experiment, const std::string& run_id,
                                   Format format, const std::vector<int>& frames) {
  const fs::path folder = experiment / run_id;
  switch (format) {
    case Format::kVtp:
      return {folder / "meshes" / "estimate.pvd",
              ExportMeshes(experiment, run_id, frames, folder / "meshes")};
    case Format::kGlb:
      return {folder / "run.glb", ExportGltf(experiment, run_id, frames, folder / "run.glb")};
    case Format::kBvh: {
      const ExportedRun run = OpenForExport(experiment, run_id, {});
      const BodyModel subject = TrackedSubject(ReadPlannedRun(folder), run.sequence);
      return {folder / "joints.bvh", ExportBvh(run, subject, folder / "joints.bvh")};
    }
    case Format::kCsv:
      return {folder / "joints.csv",
              ExportJointTable(experiment, run_id, frames, folder / "joints.csv")};
  }
  throw std::logic_error("no such format");
}

void Export(const ExportArguments& arguments) {
  int runs = 0;
  SkippedRuns skipped;
  const ExperimentRecord experiment = ReadExperimentRecord(arguments.folder);
  for (const std::string& run_id : RunsMatching(experiment, arguments.only)) {
    if (!fs::is_directory(arguments.folder / run_id / "estimate")) continue;
    skipped.SkipIfUnreadable(run_id, [&] {
      for (const Format format : arguments.formats) {
        const auto [file, frames] = ExportRun(arguments.folder, run_id, format, arguments.frames);
        fmt::print("{}: {} frames\n", file.string(), frames);
      }
    });
    ++runs;
  }
  if (runs == 0)
    throw DataError(
        fmt::format("{}: holds no run with an estimate to export", arguments.folder.string()));
  skipped.RequireNone(arguments.folder);
}

}  // namespace

void AddExportCommand(CLI::App& app) {
  auto a = std::make_shared<ExportArguments>();
  CLI::App* command = app.add_subcommand(
      "export", "Write runs as files that other programs open: surfaces, joints");
  command->add_option("DIR", a->folder, "the experiment's folder")->required();
  AddOnlyOption(*command, a->only);
  command->add_option("--frames", a->frames, "only these frames (not for bvh); default: all");
  command
      ->add_option(
          "--as", a->formats,
          "vtp: surfaces with their errors for ParaView (.vtp, .pvd); glb: surfaces as one "
          "animated glTF; bvh: the motion; csv: joints and their truth")
      ->transform(CLI::CheckedTransformer(kFormats))
      ->default_str("vtp");
  command->callback([a] { Export(*a); });
}

}  // namespace vitruvia
