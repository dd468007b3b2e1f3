// What stands still in a recording, by which a person is told from the room.
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
  double share = 0.0;                // of the sampled points that lie in it

  float HeightOf(const Vector3f& point) const { return up.dot(point) + height_m; }
};

struct Room {
  PinholeCamera camera;
  // Depth of the room behind each pixel, metres: 0 where it is not known, infinite where it lies
  // beyond the sensor's range.
  DepthImage background;
  double noise_at_1m_m = 0.0;  // standard deviation of depth; grows with the square of depth
  std::optional<FloorPlane> floor;

  float NoiseAt(float depth_m) const {
    return static_cast<float>(noise_at_1m_m) * depth_m * depth_m;
  }
};

// From frames of the recording, evenly spread; `empty`: frames without a person, only of
// BackgroundSource::kEmptyFrames. Frames that hold no measurement do not count.
Room LearnRoom(const std::vector<DepthImage>& frames, const std::vector<DepthImage>& empty,
               const PinholeCamera& camera, const CutoutSettings& settings);

// Pixels that are measured within range, in front of the background and above the floor: 255, all
// others 0.
MaskImage ForegroundOf(const DepthImage& depth, const Room& room, const CutoutSettings& settings);

}  // namespace vitruvia
