// An occluder that moves between camera and subject: a post of a person's size, or a second person.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/settings.h"
#include "geometry/mesh.h"
#include "math/vector.h"

namespace vitruvia {

enum class OccluderShape {
  kPost,
  kPerson,  // the truth's body at another moment of its motion
};
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
  OccluderShape shape = OccluderShape::kPost;
  double radius_m = 0.0;  // of a post; 0: none
  double height_m = 1.7;
  double later_s = 1.0;  // of a person: its lead over the subject in the subject's motion
  OccluderMotion motion = OccluderMotion::kStraight;
  std::array<double, 2> start_m{-2.0, 1.2};      // x and z at time 0
  std::array<double, 2> velocity_m_s{1.0, 0.0};  // of x and z
  std::vector<WayPoint> path;  // in the order of time; it stands still before and after
  Presence presence;

  bool IsThere() const { return shape == OccluderShape::kPerson || radius_m > 0.0; }
  void Describe(Fields& fields);
  std::string Problem() const;

 private:
  void DescribeShape(Fields& fields);
};

// Position of its centre at that time: x and z.
std::array<double, 2> PositionAt(const OccluderSettings& settings, double time_s);

// Adds the post as it stands at that time to a mesh in the camera frame, metres.
void AddPost(const OccluderSettings& settings, double time_s, const Rigidd& camera_from_subject,
             TriangleMesh& mesh);

}  // namespace vitruvia
