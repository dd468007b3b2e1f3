// The depth frames of a scan, rendered one by one, with their ground truth.
#pragma once

#include <memory>

#include "body/body_model.h"
#include "geometry/image.h"
#include "math/rigid.h"
#include "synth/scan/scan_scene.h"

namespace vitruvia {

struct ScanFrame {
  DepthImage depth;  // quantised to sensor.depth_unit_m
  // Relative to the subject in the first frame. The subject sways, and a scan determines only the
  // camera's pose relative to it, so this transform follows the chest.
  Rigidd camera_from_subject;
  // The swaying subject's surface and joints, camera frame.
  std::vector<Vector3f> vertices;
  std::vector<Vector3d> joints;
};

class ScanRecorder {
 public:
  explicit ScanRecorder(const ScanSceneSettings& settings);
  // Records that person instead of the settings' one.
  ScanRecorder(const ScanSceneSettings& settings, BodyModel person);
  ~ScanRecorder();

  const ScanSceneSettings& settings() const { return settings_; }
  // The subject, in the T-pose.
  const BodyModel& body() const { return body_; }
  // Its surface in the first frame, which a scan should reconstruct. Subject frame.
  const TriangleMesh& surface() const { return surface_; }

  // Frames 0 … settings.frames − 1, in any order. ConfigError if the body leaves the renderer's
  // depth range.
  ScanFrame Render(int frame);

 private:
  struct Jitter;

  std::vector<Vector3f> Stand(double time_s, BoneTransforms& bones) const;
  Rigidd CameraAt(int frame) const;

  ScanSceneSettings settings_;
  BodyModel body_;
  TriangleMesh surface_;
  Rigidd chest_at_start_;  // posed_from_rest
  std::unique_ptr<Jitter> jitter_;
  std::unique_ptr<class DepthRenderer> renderer_;
};

}  // namespace vitruvia
