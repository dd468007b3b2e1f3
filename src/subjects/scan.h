// A complete scan: frames from a scene or a stored sequence are fused, and the result is checked
// and compared with the truth if there is one.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "body/body_model.h"
#include "config/json_settings.h"
#include "learning/scan/body_check.h"
#include "learning/scan/scan_fusion.h"
#include "synth/scan/scan_scene.h"

namespace vitruvia {

enum class ScanSource { kScene, kSequence };

struct ScanSettings {
  std::string title;
  ScanSource source = ScanSource::kScene;
  ScanSceneSettings scene;         // of source kScene
  std::filesystem::path sequence;  // of source kSequence: a folder as `vitruvia synth` writes it
  ViewSettings first_view;         // of source kSequence: where its first frame was taken from;
                                   // the camera is the sequence's
  ScanFusionSettings fusion;
  BodyCheckSettings check;

  void Describe(Fields& fields);
};

// A config file as `vitruvia scan` takes it, with overrides applied.
ScanSettings ReadScanSettings(const std::filesystem::path& file,
                              const Json& overrides = Json::object());

struct DistanceSummary {
  double mean_m = 0.0, p95_m = 0.0, max_m = 0.0;
};
// Distances of the vertices of `from` to the nearest point of the surface `to`.
DistanceSummary SurfaceDistance(const TriangleMesh& from, const TriangleMesh& to);

struct CameraPathError {
  double rotation_mean_deg = 0.0, rotation_max_deg = 0.0;
  double translation_mean_m = 0.0, translation_max_m = 0.0;  // of the camera's centre
};

// Ground truth of a scanned scene.
struct ScanTruth {
  BodyModel body;        // in the T-pose
  TriangleMesh surface;  // in the pose of the first frame; subject frame
  CameraPathError path;
  DistanceSummary scan_to_truth, truth_to_scan;
};

struct ScanResult {
  ScanSurface surface;             // .mesh: subject frame, metres
  std::vector<FusedFrame> frames;  // those used
  double render_ms = 0.0;          // rendering or reading all frames
  double fuse_ms = 0.0;            // all frames
  double extract_ms = 0.0;
  std::optional<ScanTruth> truth;  // of source kScene
};

// Fuses all frames, shows progress and can be interrupted. RunError naming the frame if the camera
// is lost; DataError if there is no body, more than one, or a hole for a head.
//
// The subject frame follows from the first camera's pose relative to the floor, which is that of
// the scene, or first_view. Later alignments are relative to it.
ScanResult Scan(const ScanSettings& settings);
// The same, but for the distances between scan and truth, which take as long as 10 frames.
ScanResult ScanWithoutDistances(const ScanSettings& settings);
// Scans that person in the scene instead of the scene's own.
ScanResult ScanPerson(const ScanSettings& settings, const BodyModel& person);

// The content of scan.json.
Json ScanRecord(const ScanSettings& settings, const ScanResult& result);

}  // namespace vitruvia
