// A recording of a room imported, decoded, cut out, followed and written: how well the person is
// cut out, held against the scene's true masks, and how fast.
#include <algorithm>
#include <filesystem>
#include <thread>

#include "bench/bench.h"
#include "config/json_settings.h"
#include "importers/depth_import.h"
#include "math/statistics.h"
#include "sequence/sequence.h"
#include "support/mask_truth.h"
#include "support/temporary_folder.h"
#include "synth/scene/scene.h"

namespace vitruvia::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kImportFrames = 96;
constexpr int kRuns = 3;

struct NamedSensor {
  const char* name;
  SensorModel model;
};
constexpr NamedSensor kSensors[] = {{"ideal", SensorModel::kIdeal},
                                    {"kinect_v1", SensorModel::kKinectV1},
                                    {"kinect_one", SensorModel::kKinectOne}};

// The settings of the cutout were chosen on the first two and measured on the others.
constexpr const char* kRooms[] = {"room_walk",         "room_sit",       "room_check_walk",
                                  "room_check_boxing", "room_check_sit", "room_check_floor"};

// A scene of configs/, seen by that sensor.
SceneSettings Scene(const std::string& name, SensorModel sensor) {
  auto scene = ReadSettingsFile<SceneSettings>(fs::path(VITRUVIA_SOURCE_DIR) / "configs/scenes" /
                                               (name + ".json"));
  scene.sensor.model = sensor;
  return scene;
}

DepthImportSettings ImportOf(const SceneSettings& scene, const fs::path& sequence) {
  const PinholeCamera& camera = scene.view.camera;
  DepthImportSettings settings;
  settings.images = sequence / "depth";
  settings.camera = {camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy};
  settings.unit_m = scene.sensor.depth_unit_m;
  settings.fps = scene.fps;
  settings.empty_frames.images = sequence / "empty_room";
  settings.cutout.background.source = BackgroundSource::kEmptyFrames;
  return settings;
}

double FramesPerSecond(const DepthImportSettings& settings, int threads, const fs::path& output) {
  return 1e3 * kImportFrames /
         MedianMs(kRuns, [&] { ImportDepthSequence(settings, threads, output); });
}

int AllThreads() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

// The overlap with the true mask and the pixels of feet that are lost, of all frames and the worst.
void AddAgreement(const std::string& name, const SequenceReader& scene,
                  const SequenceReader& imported, std::vector<Row>& rows) {
  std::vector<double> missed, feet_px;
  for (int i = 0; i < scene.info().frames; ++i) {
    const MaskImage mask = imported.ReadMask(i);
    missed.push_back(1.0 - MaskOverlap(mask, scene.ReadMask(i), scene.ReadDepthWithRoom(i)));
    feet_px.push_back(FeetLost_px(scene, i, mask));
  }
  rows.push_back({"cut_out_overlap_mean_" + name, 1.0 - Mean(missed), ""});
  rows.push_back({"cut_out_overlap_least_" + name, 1.0 - Maximum(missed), ""});
  rows.push_back({"cut_out_feet_lost_most_" + name, Maximum(feet_px), "px"});
}

void AddAgreements(std::vector<Row>& rows) {
  for (const std::string name : kRooms) {
    for (const NamedSensor& sensor : kSensors) {
      const TemporaryFolder folder;
      SceneSettings scene = Scene(name, sensor.model);
      scene.frames /= 2;
      scene.fps /= 2;
      SynthesizeSequence(scene, folder / "scene");
      ImportDepthSequence(ImportOf(scene, folder / "scene"), AllThreads(), folder / "imported");
      AddAgreement(name + "_" + sensor.name, SequenceReader(folder / "scene"),
                   SequenceReader(folder / "imported"), rows);
    }
  }
}

}  // namespace

std::vector<Row> ImportDepth() {
  const TemporaryFolder folder;
  SceneSettings scene = Scene("room_walk", SensorModel::kKinectV1);
  scene.frames = kImportFrames;
  SynthesizeSequence(scene, folder / "scene");
  const DepthImportSettings settings = ImportOf(scene, folder / "scene");
  std::vector<Row> rows = {
      {"import_depth_640x480_one_thread", FramesPerSecond(settings, 1, folder / "one"), "1/s"},
      {"import_depth_640x480_all_threads", FramesPerSecond(settings, AllThreads(), folder / "all"),
       "1/s"}};
  AddAgreements(rows);
  return rows;
}

}  // namespace vitruvia::bench
