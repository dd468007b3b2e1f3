// An occluder that moves between camera and subject: a post of a person's size.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/settings.h"
#include "geometry/mesh.h"
#include "math/vector.h"

namespace vitruvia {

enum class OccluderMotion { kStraight, kPath };

struct WayPoint {
  double time_s = 0.0;
  std::array<double, 2> position_m{0.0, 0.0};  // x and z

  void Describe(Fields& fields);
};

// The interval of time in which an object is in the scene.
struct Presence {
  double from_s = 0.0, to_s = 1e6;

  bool Holds(double time_s) const { return time_s >= from_s && time_s < to_s; }
  void Describe(Fields& fields);
  std::string Problem() const;
};

// Moves on the floor; subject frame's axes, origin under the start.
struct OccluderSettings {
  double radius_m = 0.0;  // 0: none
  double height_m = 1.7;
  OccluderMotion motion = OccluderMotion::kStraight;
  std::array<double, 2> start_m{-2.0, 1.2};      // x and z at time 0
  std::array<double, 2> velocity_m_s{1.0, 0.0};  // of x and z
  std::vector<WayPoint> path;  // in the order of time; it stands still before and after
  Presence presence;

  bool IsThere() const { return radius_m > 0.0; }
  void Describe(Fields& fields);
  std::string Problem() const;
};

// Position of its centre at that time: x and z.
std::array<double, 2> PositionAt(const OccluderSettings& settings, double time_s);

// Adds the occluder as it stands at that time to a mesh in the camera frame, metres.
void AddOccluder(const OccluderSettings& settings, double time_s, const Rigidd& camera_from_subject,
                 TriangleMesh& mesh);

}  // namespace vitruvia
