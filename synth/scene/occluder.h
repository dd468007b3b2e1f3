// Something that walks past between camera and subject: a post of a person's size.
#pragma once

#include <array>

#include "config/settings.h"
#include "geometry/mesh.h"
#include "math/vector.h"

namespace vitruvia {

// Moves along a straight line on the floor; subject frame's axes, origin under the start.
struct OccluderSettings {
  double radius_m = 0.0;  // 0: none
  double height_m = 1.7;
  std::array<double, 2> start_m{-2.0, 1.2};      // x and z at time 0
  std::array<double, 2> velocity_m_s{1.0, 0.0};  // of x and z

  bool IsThere() const { return radius_m > 0.0; }
  void Describe(Fields& fields);
};

// Adds the occluder as it stands at that time to a mesh in the camera frame, metres.
void AddOccluder(const OccluderSettings& settings, double time_s, const Rigidd& camera_from_subject,
                 TriangleMesh& mesh);

}  // namespace vitruvia
