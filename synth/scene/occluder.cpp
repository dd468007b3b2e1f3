#include "synth/scene/occluder.h"

#include <cmath>
#include <numbers>

#include "math/rigid.h"

namespace vitruvia {
namespace {

constexpr int kSides = 24;

}  // namespace

void OccluderSettings::Describe(Fields& f) {
  f.Number("radius_m", radius_m,
           {.meaning = "radius of the post that moves past the subject; 0: no post",
            .unit = "m",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kInput});
  f.Number("height_m", height_m,
           {.meaning = "height of the post above the floor",
            .unit = "m",
            .min = 0.01,
            .max = 3.0,
            .origin = Origin::kInput});
  f.Numbers(
      "start_m", start_m,
      {.meaning =
           "position of the post at time 0: x to the subject's left, z to the direction that the "
           "subject faces first",
       .unit = "m",
       .origin = Origin::kInput});
  f.Numbers(
      "velocity_m_s", velocity_m_s,
      {.meaning = "velocity of the post along x and z", .unit = "m/s", .origin = Origin::kInput});
}

void AddOccluder(const OccluderSettings& s, double time_s, const Rigidd& camera_from_subject,
                 TriangleMesh& mesh) {
  if (!s.IsThere()) return;
  const auto first = static_cast<int>(mesh.vertices.size());
  const double x = s.start_m[0] + time_s * s.velocity_m_s[0];
  const double z = s.start_m[1] + time_s * s.velocity_m_s[1];
  const auto add = [&](double dx, double y, double dz) {
    mesh.vertices.push_back((camera_from_subject * Vector3d(x + dx, y, z + dz)).cast<float>());
  };
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSides;
    add(s.radius_m * std::cos(angle), 0.0, -s.radius_m * std::sin(angle));
    add(s.radius_m * std::cos(angle), s.height_m, -s.radius_m * std::sin(angle));
  }
  add(0.0, s.height_m, 0.0);
  const int top = first + 2 * kSides;
  for (int i = 0; i < kSides;
       ++i) {  // seen from above, counter-clockwise; no floor: nobody sees it
    const int low = first + 2 * i, next = first + 2 * ((i + 1) % kSides);
    mesh.triangles.push_back({low, next, next + 1});
    mesh.triangles.push_back({low, next + 1, low + 1});
    mesh.triangles.push_back({top, low + 1, next + 1});
  }
}

}  // namespace vitruvia
