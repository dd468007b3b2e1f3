// Rooms of planes and boxes as a level camera sees them, made ray by ray.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "geometry/camera.h"
#include "geometry/image.h"
#include "geometry/mesh.h"

namespace vitruvia {

inline PinholeCamera RoomCamera() { return {160, 120, 142.5, 142.5, 79.5, 59.5}; }

// A box in the camera frame that shows only its front.
struct FrontBox {
  double left, right, top, bottom;  // x and y, metres
  double depth;
};

struct RoomView {
  double wall_m = 4.0;           // depth of the wall behind; 0: none
  double camera_height_m = 0.0;  // above a floor; 0: no floor
  double pitch = 0.0;            // of the camera downwards, radians
  std::vector<FrontBox> boxes{};

  Vector3d Up() const { return {0.0, -std::cos(pitch), -std::sin(pitch)}; }

  DepthImage Rendered(const PinholeCamera& camera = RoomCamera()) const {
    DepthImage depth(camera.width, camera.height);
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const Vector3d ray = camera.Unproject<double>(u, v, 1.0);
        double z = wall_m > 0.0 ? wall_m : 1e9;
        const double down = -Up().dot(ray);
        if (camera_height_m > 0.0 && down > 0.0) z = std::min(z, camera_height_m / down);
        for (const FrontBox& box : boxes) {
          const Vector3d at = box.depth * ray;
          if (at.x() >= box.left && at.x() <= box.right && at.y() >= box.top &&
              at.y() <= box.bottom)
            z = std::min(z, box.depth);
        }
        depth(u, v) = z < 12.0 ? static_cast<float>(z) : 0.0f;
      }
    }
    return depth;
  }
};

// Depth noise that grows with the square of depth.
inline DepthImage Noisy(DepthImage depth, double at_1m_m, RandomStream& random) {
  for (float& z : depth.pixels()) {
    if (z > 0.0f) z += static_cast<float>(random.Normal(0.0, at_1m_m) * z * z);
  }
  return depth;
}

}  // namespace vitruvia
