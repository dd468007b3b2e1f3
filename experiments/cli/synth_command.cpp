#include "experiments/cli/synth_command.h"

#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>

#include "core/error.h"
#include "core/files.h"
#include "core/message.h"
#include "experiments/cli/verify_command.h"
#include "experiments/plan/run_plan.h"
#include "reports/pictures/depth_sheet.h"
#include "synth/scene/preview.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr int kPreviewFrames = 12;

struct SynthArguments {
  fs::path scene, output, preview, verified;
};

void RequirePng(const fs::path& file) {
  if (file.extension() == ".png") return;
  throw ConfigError(
      fmt::format("synth: --preview {}: expected a name that ends in .png", file.string()));
}

void Preview(const SceneSettings& scene, const fs::path& file) {
  const ScenePreview preview = PreviewScene(scene, kPreviewFrames);
  for (const std::string& warning : preview.warnings) PrintMessage("warning: {}\n", warning);
  std::vector<DepthTile> tiles;
  for (const PreviewFrame& frame : preview.frames) {
    tiles.push_back(
        {fmt::format("frame {}, {:.2f} s", frame.frame, frame.time_s), frame.depth, frame.body});
  }
  if (!file.parent_path().empty()) MakeFolder(file.parent_path());
  WriteDepthSheet(file, tiles);
  fmt::print("{}\n", file.string());
}

void Synthesize(const SynthArguments& a) {
  if (!a.verified.empty()) return VerifyStored(a.verified);
  if (a.scene.empty() || (a.output.empty() && a.preview.empty()))
    throw ConfigError(
        "synth: expected SCENE.json -o DIR, SCENE.json --preview FILE.png, or "
        "--verify DIR");
  if (!a.preview.empty()) RequirePng(a.preview);
  const SceneSettings scene = ReadScene(a.scene);
  if (!a.preview.empty()) Preview(scene, a.preview);
  if (a.output.empty()) return;
  SynthesizeSequence(scene, a.output);
  fmt::print("{}\n", a.output.string());
}

}  // namespace

void AddSynthCommand(CLI::App& app) {
  const auto a = std::make_shared<SynthArguments>();
  CLI::App* synth =
      app.add_subcommand("synth", "Synthesise a sequence from a scene, preview or verify one");
  synth->add_option("SCENE", a->scene, "scene file");
  synth->add_option("-o,--output", a->output, "folder of the new sequence");
  synth->add_option("--preview", a->preview,
                    "PNG file for a sheet of frames, drawn without making the sequence");
  synth->add_option("--verify", a->verified,
                    "folder of a sequence to check, instead of making one");
  synth->callback([a] { Synthesize(*a); });
}

}  // namespace vitruvia
