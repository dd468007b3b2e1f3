// Scan fusion: depth frames of a moving camera in, one surface out.
//
//   ScanFusion fusion(settings, camera, subject_from_first_camera);
//   for each frame: fusion.FuseFrame(depth);
//   ScanSurface surface = fusion.Surface();
//
// The surface is in the subject frame if subject_from_first_camera is correct: a scan determines
// the surface only up to this transform. Deterministic for any number of threads.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/worker_team.h"
#include "learning/scan/alignment.h"
#include "learning/scan/scan_surface.h"
#include "learning/scan/tsdf_volume.h"
#include "math/rigid.h"

namespace vitruvia {

enum class FrameOutcome { kFused, kEmpty, kLost };

enum class ScanStep { kPrepare, kAlign, kIntegrate, kRaycast };
inline constexpr int kScanStepCount = 4;
inline constexpr std::array<const char*, kScanStepCount> kScanStepNames = {"prepare", "align",
                                                                           "integrate", "raycast"};

struct FusedFrame {
  FrameOutcome outcome = FrameOutcome::kFused;
  std::string message;  // why the frame is lost or empty, with numbers
  Rigidd subject_from_camera;
  double matched_share = 0.0, rms_m = 0.0, condition = 0.0;  // 0 for the first frame
  int iterations = 0;
  std::array<double, kScanStepCount> step_ms{};
};

class ScanFusion {
 public:
  ScanFusion(const ScanFusionSettings& settings, const PinholeCamera& camera,
             const Rigidd& subject_from_first_camera);

  // A lost or empty frame changes nothing; the next frame starts from the last known pose. Throws
  // std::invalid_argument if the image is not of the camera's size.
  FusedFrame FuseFrame(const DepthImage& depth);

  ScanSurface Surface() const;
  const TsdfVolume& volume() const { return volume_; }

 private:
  std::vector<PointMap> Pyramid(const DepthImage& depth) const;
  std::string ReasonForLoss(const AlignmentResult& result) const;

  ScanFusionSettings settings_;
  PinholeCamera camera_;
  Vector3d center_;
  TsdfVolume volume_;
  Rigidd subject_from_camera_;
  std::unique_ptr<WorkerTeam> team_;
  ModelView model_;  // empty before the first frame
};

}  // namespace vitruvia
