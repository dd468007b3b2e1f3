// The static room of a scene: floor, walls and furniture.
#pragma once

#include <array>
#include <vector>

#include "config/settings.h"
#include "geometry/mesh.h"
#include "math/rigid.h"

namespace vitruvia {

// A box: a seat, a table top, a leg, a cupboard. Subject frame's axes, origin on the floor under
// the start.
struct FurnitureSettings {
  std::array<double, 2> position_m{0.0, 0.0};   // x and z of its middle
  std::array<double, 3> size_m{0.5, 0.5, 0.5};  // along x, y and z
  double base_m = 0.0;                          // of its lower side above the floor
  double turn_deg = 0.0;                        // about the vertical

  void Describe(Fields& fields);
};

// Walls are planes at these distances from the start; 0: no such wall.
struct RoomSettings {
  bool floor = false;
  double wall_behind_m = 0.0, wall_left_m = 0.0, wall_right_m = 0.0;  // of the subject
  double wall_height_m = 2.6;
  std::vector<FurnitureSettings> furniture;
  int empty_frames = 0;

  bool IsThere() const {
    return floor || wall_behind_m > 0.0 || wall_left_m > 0.0 || wall_right_m > 0.0 ||
           !furniture.empty();
  }
  void Describe(Fields& fields);
};

// All of it in the camera frame, metres.
TriangleMesh RoomMesh(const RoomSettings& settings, const Rigidd& camera_from_subject);

}  // namespace vitruvia
