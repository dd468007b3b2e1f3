// The static scene of a recording: background, noise and floor, which separate a person from the
// room.
#pragma once

#include <optional>
#include <vector>

#include "cutout/settings.h"
#include "geometry/camera.h"
#include "geometry/image.h"
#include "geometry/mesh.h"

namespace vitruvia {

// The plane of the points with up · p + height_m = 0, camera frame.
struct FloorPlane {
  Vector3f up = -Vector3f::UnitY();  // unit length
  float height_m = 0.0f;             // of the camera above the floor
  double share = 0.0;                // share of the sampled points that lie in the plane

  float HeightOf(const Vector3f& point) const { return up.dot(point) + height_m; }
  double TiltDegrees() const;  // between its normal and the image's upright
};

struct Room {
  PinholeCamera camera;
  // Depth of the room behind each pixel, metres: 0 where it is not known, infinite where it lies
  // beyond the sensor's range.
  DepthImage background;
  double noise_at_1m_m = 0.0;  // standard deviation of depth at 1 m; grows with the square of depth
  std::optional<FloorPlane> floor;

  float NoiseAt(float depth_m) const {
    return static_cast<float>(noise_at_1m_m) * depth_m * depth_m;
  }
};

// What lies behind a person at one pixel.
struct RoomDepth {
  float depth_m = 0.0f;   // infinite where nothing is known or within range
  float margin_m = 0.0f;  // a pixel that is nearer by more than this is in front of it

  bool IsInFront(float z) const { return z < depth_m - margin_m; }
};

// The background, or the floor where there is no background.
RoomDepth RoomDepthAt(const Room& room, const CutoutSettings& settings, int u, int v);

// Learns the room from evenly spaced frames of the recording. `empty`: frames without a person,
// used only with BackgroundSource::kEmptyFrames. Frames without any measurement are ignored.
Room LearnRoom(const std::vector<DepthImage>& frames, const std::vector<DepthImage>& empty,
               const PinholeCamera& camera, const CutoutSettings& settings);

// Pixels that are measured within range, in front of the background and above the floor: 255, all
// others 0.
MaskImage ForegroundOf(const DepthImage& depth, const Room& room, const CutoutSettings& settings);

}  // namespace vitruvia
