// A recording of a room imported: decoded, cut out, followed and written.
#include <algorithm>
#include <filesystem>
#include <thread>

#include "bench/bench.h"
#include "config/json_settings.h"
#include "importers/depth_import.h"
#include "sequence/sequence.h"
#include "support/temporary_folder.h"
#include "synth/scene/scene.h"

namespace vitruvia::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kImportFrames = 96;
constexpr int kRuns = 3;

SceneSettings Scene() {
  auto scene = ReadSettingsFile<SceneSettings>(fs::path(VITRUVIA_SOURCE_DIR) /
                                               "configs/scenes/room_walk.json");
  scene.sensor.model = SensorModel::kKinectV1;
  scene.frames = kImportFrames;
  return scene;
}

DepthImportSettings ImportOf(const SceneSettings& scene, const fs::path& sequence) {
  const PinholeCamera& camera = scene.view.camera;
  DepthImportSettings settings;
  settings.images = sequence / "depth";
  settings.camera = {camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy};
  settings.unit_m = scene.sensor.depth_unit_m;
  settings.empty_frames.images = sequence / "empty_room";
  settings.cutout.background.source = BackgroundSource::kEmptyFrames;
  return settings;
}

double FramesPerSecond(const DepthImportSettings& settings, int threads, const fs::path& output) {
  return 1e3 * kImportFrames /
         MedianMs(kRuns, [&] { ImportDepthSequence(settings, threads, output); });
}

}  // namespace

std::vector<Row> ImportDepth() {
  const TemporaryFolder folder;
  const SceneSettings scene = Scene();
  SynthesizeSequence(scene, folder / "scene");
  const DepthImportSettings settings = ImportOf(scene, folder / "scene");
  const int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return {{"import_depth_640x480_one_thread", FramesPerSecond(settings, 1, folder / "one"), "1/s"},
          {"import_depth_640x480_all_threads", FramesPerSecond(settings, threads, folder / "all"),
           "1/s"}};
}

}  // namespace vitruvia::bench
