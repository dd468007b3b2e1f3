// Scans of a small scene: what comes out, and how a bad one is refused.
#include "subjects/scan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "experiments/cli/commands.h"
#include "geometry/mesh_io.h"
#include "support/temporary_folder.h"
#include "synth/scan/record_scan.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr double kTurnsPerFrame = 0.0025;

// A few frames of a mannequin from the front, coarse enough for a test.
ScanSettings SmallScan(int frames = 8) {
  ScanSettings settings;
  settings.scene.camera = {160, 120, 142.5, 142.5, 79.5, 59.5};
  settings.scene.truth.refinement.subdivisions = 2;
  settings.scene.frames = frames;
  settings.scene.path.turns = kTurnsPerFrame * frames;
  settings.scene.path.heights_m = {1.1, 1.1};
  settings.scene.path.look_at_heights_m = {0.9, 0.9};
  settings.scene.path.radius_m = 2.2;
  settings.scene.path.jitter_m = settings.scene.path.jitter_deg = 0.0;
  settings.fusion.volume.voxel_m = 0.01;
  settings.fusion.volume.truncation_m = 0.03;
  settings.fusion.alignment.iterations = {5, 5};
  settings.fusion.surface.min_weight = 0.5;
  settings.check = {.min_area_m2 = 0.2, .max_head_hole_m2 = 1.0};  // only the front is seen
  return settings;
}

template <class Exception>
void ExpectRefusal(const ScanSettings& settings, const std::string& words) {
  try {
    Scan(settings);
    FAIL() << "accepted, expected: " << words;
  } catch (const Exception& error) {
    EXPECT_THAT(error.what(), HasSubstr(words));
  }
}

TEST(Scan, FindsTheSubjectWhereItStands) {
  const ScanResult result = Scan(SmallScan());
  EXPECT_EQ(result.frames.size(), 8u);
  ASSERT_TRUE(result.truth.has_value());
  EXPECT_LT(result.truth->scan_to_truth.mean_m, 0.003);
  EXPECT_LT(result.truth->path.translation_max_m, 0.01);
  EXPECT_LT(result.truth->path.rotation_max_deg, 0.5);
  EXPECT_GT(SurfaceArea(result.surface.mesh), 0.5);
  EXPECT_EQ(result.surface.normals.size(), result.surface.mesh.vertices.size());
  EXPECT_EQ(result.surface.weights.size(), result.surface.mesh.vertices.size());
}

TEST(Scan, IsTheSameAgainAndForAnyNumberOfThreads) {
  ScanSettings settings = SmallScan(3);
  settings.scene.sensor.model = SensorModel::kGaussian;
  const ScanResult first = Scan(settings);
  settings.fusion.threads = 1;
  EXPECT_EQ(Scan(settings).surface.mesh.vertices, first.surface.mesh.vertices);
}

TEST(Scan, StrideSkipsFrames) {
  ScanSettings settings = SmallScan();
  settings.fusion.stride = 3;
  EXPECT_EQ(Scan(settings).frames.size(), 3u);
}

TEST(Scan, SaysInWhichFrameTheCameraWasLost) {
  ScanSettings settings = SmallScan();
  settings.scene.path.turns = 1.0;  // in 8 frames
  ExpectRefusal<RunError>(settings, "the camera is lost in frame 1: ");
}

TEST(Scan, RefusesAnEmptyView) {
  ScanSettings settings = SmallScan();
  settings.scene.path.radius_m = 4.0;
  settings.scene.path.look_at_heights_m = {4.9, 4.9};
  ExpectRefusal<DataError>(settings, "no body: frame 0: it has no depth");
}

TEST(Scan, RefusesTwoBodies) {
  ScanSettings settings = SmallScan();
  settings.scene.path.start_deg = 70.0;
  settings.scene.bystanders = {{.place_m = {0.0, -0.65}}};
  ExpectRefusal<DataError>(settings, "two bodies");
}

TEST(Scan, RefusesAHoleForAHead) {
  ScanSettings settings = SmallScan(90);
  settings.check = {};
  // Round the subject with the head out of view.
  settings.scene.path.turns = 1.0;
  settings.scene.path.heights_m = {1.0, 1.0};
  settings.scene.path.look_at_heights_m = {0.62, 0.62};
  settings.scene.path.radius_m = 2.0;
  settings.fusion.loss.max_step_m = 0.3;
  settings.fusion.loss.max_step_deg = 10.0;
  settings.fusion.alignment.max_distance_m = 0.15;
  ExpectRefusal<DataError>(settings, "a hole for a head");
}

TEST(Scan, StoredFramesGiveTheSameSurface) {
  const TemporaryFolder folder;
  ScanSettings settings = SmallScan(3);
  const ScanResult streamed = Scan(settings);
  RecordScan(settings.scene, folder / "frames");
  ScanSettings stored = settings;
  stored.source = ScanSource::kSequence;
  stored.sequence = folder / "frames";
  stored.first_view.position_m = {0.0, 1.1, 2.2};
  stored.first_view.look_at_m = {0.0, 0.9, 0.0};
  const ScanResult read = Scan(stored);
  EXPECT_FALSE(read.truth.has_value());
  const DistanceSummary apart = SurfaceDistance(read.surface.mesh, streamed.surface.mesh);
  EXPECT_LT(apart.max_m, 1e-4);
}

TEST(ScanCommand, WritesMeshAndRecordOrNothing) {
  const TemporaryFolder folder;
  ScanSettings settings = SmallScan(2);
  const auto call = [&](const fs::path& output) {
    WriteWholeFile(folder / "scan_config.json", WriteSettings(settings).dump());
    const std::string config = (folder / "scan_config.json").string(), out = output.string();
    const char* const arguments[] = {"vitruvia", "scan", config.c_str(), "-o", out.c_str()};
    return RunCommandLine(5, arguments);
  };
  ASSERT_EQ(call(folder / "good"), static_cast<int>(ExitCode::kSuccess));
  const Json record = ReadJsonFile(folder / "good" / "scan.json");
  EXPECT_EQ(record["frames"]["fused"], 2);
  EXPECT_EQ(ReadMesh(folder / "good" / "scan.ply").vertices.size(), record["surface"]["vertices"]);
  EXPECT_GT(record["truth"]["truth_to_scan"]["max_m"].get<double>(), 0.0);

  settings.scene.path.turns = 0.5;
  EXPECT_EQ(call(folder / "lost"), static_cast<int>(ExitCode::kFailedRun));
  EXPECT_FALSE(fs::exists(folder / "lost"));
}

}  // namespace
}  // namespace vitruvia
