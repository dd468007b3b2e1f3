// The scene at any time, and its rendering in the scene's camera.
#pragma once

#include <vector>

#include "body/body_model.h"
#include "synth/cloth/garment.h"
#include "synth/render/depth_renderer.h"
#include "synth/scene/scene.h"

namespace vitruvia {

// Clipping planes of the renderer; the body must stay between them.
inline constexpr double kNearest_m = 0.2, kFarthest_m = 12.0;

// Throws ConfigError, which names the setting, if a vertex is outside of the clipping planes: its
// surface would be clipped silently.
void RequireInRange(const std::vector<Vector3f>& vertices_in_camera, int frame,
                    const char* setting);

// The body's surface and joints in the camera frame, and the transforms of its bones.
struct TruePose {
  std::vector<Vector3f> vertices;
  std::vector<Vector3<double>> joints;
  BoneTransforms camera_from_rest;
};
TruePose Pose(const BodyModel& body, const MotionSample& sample, Skinning skinning,
              const Rigidd& camera_from_subject);

// The dressed and posed body with its surroundings, seen by a noise-free camera. Settings and
// motion must outlive it.
class Stage {
 public:
  Stage(const SceneSettings& settings, const BodyModel& truth, const Motion& motion);

  TruePose PosedAt(double time_s);
  // Without a person; empty where the scene has no room.
  const DepthImage& room() const { return room_; }
  // `body` as PosedAt gave it last, for the same time.
  DepthImage Rendered(double time_s, const TruePose& body);
  // The body without anything that hides it.
  DepthImage RenderedAlone(const TruePose& body);
  // Where `depth`, rendered at the same time, shows the body.
  MaskImage BodyMask(const TruePose& body, const DepthImage& depth);

 private:
  void AddOccluder(double time_s, TriangleMesh& seen) const;

  const SceneSettings& settings_;
  const Motion& motion_;
  Rigidd camera_from_subject_;
  Garment garment_;
  BodyModel dressed_;  // its surface changes from frame to frame
  DepthRenderer renderer_;
  DepthImage room_;
};

// The sensor's output for a frame: possibly late, noisy, or empty.
class StageSensor {
 public:
  explicit StageSensor(const SceneSettings& settings);

  // `true_depth` as the stage renders it at `time_s`, the time of the frame.
  DepthImage Measured(int frame, double time_s, const DepthImage& true_depth, Stage& stage) const;

 private:
  const SceneSettings& settings_;
  std::uint64_t seed_;
  std::vector<bool> lost_;
};

}  // namespace vitruvia
