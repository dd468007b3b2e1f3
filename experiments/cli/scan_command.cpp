#include "experiments/cli/scan_command.h"

#include <memory>

#include <CLI/CLI.hpp>

#include "core/error.h"
#include "core/files.h"
#include "geometry/mesh_io.h"
#include "subjects/scan.h"
#include "synth/scan/record_scan.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kRecordName = "scan.json";

void PrintSummary(const ScanResult& result) {
  fmt::print("{} frames, {} vertices, {} triangles, {} holes, {} pieces\n", result.frames.size(),
             result.surface.mesh.vertices.size(), result.surface.mesh.triangles.size(),
             result.surface.holes.size(), result.surface.components.size());
  if (!result.truth) return;
  const ScanTruth& truth = *result.truth;
  const auto print = [](const char* what, const DistanceSummary& d) {
    fmt::print("{}: mean {:.2f} mm, p95 {:.2f} mm, max {:.2f} mm\n", what, 1e3 * d.mean_m,
               1e3 * d.p95_m, 1e3 * d.max_m);
  };
  print("scan to truth", truth.scan_to_truth);
  print("truth to scan", truth.truth_to_scan);
  fmt::print("camera path: {:.1f} mm mean, {:.1f} mm max; {:.3f}° mean, {:.3f}° max\n",
             1e3 * truth.path.translation_mean_m, 1e3 * truth.path.translation_max_m,
             truth.path.rotation_mean_deg, truth.path.rotation_max_deg);
}

void StoreFrames(const ScanSettings& settings, const fs::path& folder) {
  if (settings.source != ScanSource::kScene) {
    throw ConfigError(
        "scan: --store-frames: expected a config whose source is a scene; the frames "
        "of a sequence are stored already");
  }
  RecordScan(settings.scene, folder);
  fmt::print("{}\n", folder.string());
}

void ScanToFolder(const ScanSettings& settings, const fs::path& output) {
  StagedFolder folder(output, kRecordName);
  const ScanResult result = Scan(settings);
  WriteMesh(folder.path() / "scan.ply", result.surface.mesh);
  WriteWholeFile(folder.path() / kRecordName, ScanRecord(settings, result).dump(2) + "\n");
  folder.Commit();
  PrintSummary(result);
  fmt::print("{}\n", output.string());
}

struct ScanArguments {
  fs::path config, output, frames;
};

void CarryOut(const ScanArguments& arguments) {
  if (arguments.output.empty() && arguments.frames.empty()) {
    throw ConfigError("scan: expected -o DIR for the scan, or --store-frames DIR");
  }
  const ScanSettings settings = ReadScanSettings(arguments.config);
  if (!arguments.frames.empty()) StoreFrames(settings, arguments.frames);
  if (!arguments.output.empty()) ScanToFolder(settings, arguments.output);
}

}  // namespace

void AddScanCommand(CLI::App& app) {
  auto arguments = std::make_shared<ScanArguments>();
  CLI::App* scan = app.add_subcommand("scan", "Scan a subject with a moving depth camera");
  scan->add_option("CONFIG", arguments->config, "scan config file")->required();
  scan->add_option("-o,--output", arguments->output, "folder of the scan: scan.ply, scan.json");
  scan->add_option("--store-frames", arguments->frames,
                   "also write the scene's depth frames, as a sequence, to this folder");
  scan->callback([arguments] { CarryOut(*arguments); });
}

}  // namespace vitruvia
