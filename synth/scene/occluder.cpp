#include "synth/scene/occluder.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include <fmt/format.h>

#include "math/rigid.h"

namespace vitruvia {
namespace {

constexpr int kSides = 24;

}  // namespace

void WayPoint::Describe(Fields& f) {
  f.Number("time_s", time_s,
           {.meaning = "time at which the occluder is at this place",
            .unit = "s",
            .min = 0.0,
            .max = 1e6,
            .required = true});
  f.Numbers(
      "position_m", position_m,
      {.meaning = "place of the occluder: x to the subject's left, z to the direction that the "
                  "subject faces first",
       .unit = "m",
       .required = true});
}

void Presence::Describe(Fields& f) {
  f.Number("from_s", from_s,
           {.meaning = "time from which on it is there", .unit = "s", .min = 0.0, .max = 1e6});
  f.Number("to_s", to_s,
           {.meaning = "time from which on it is gone", .unit = "s", .min = 0.0, .max = 1e6});
}

std::string Presence::Problem() const {
  if (from_s < to_s) return "";
  return fmt::format("from_s {:g} and to_s {:g}: expected it to go after it has come", from_s,
                     to_s);
}

void OccluderSettings::DescribeShape(Fields& f) {
  f.Choice("shape", shape, {{"post", OccluderShape::kPost}, {"person", OccluderShape::kPerson}},
           {.meaning = "what moves past the subject: a post, or a second person with the subject's "
                       "body and motion"});
  if (f.Applies(shape == OccluderShape::kPerson)) {
    f.Number("later_s", later_s,
             {.meaning = "time by which the second person is ahead of the subject in the subject's "
                         "motion",
              .unit = "s",
              .min = -1e6,
              .max = 1e6,
              .origin = Origin::kInput});
  }
  if (!f.Applies(shape == OccluderShape::kPost)) return;
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
}

void OccluderSettings::Describe(Fields& f) {
  DescribeShape(f);
  f.Choice("motion", motion,
           {{"straight", OccluderMotion::kStraight}, {"path", OccluderMotion::kPath}},
           {.meaning = "how the occluder moves: at one velocity, or along a path of way points"});
  if (f.Applies(motion == OccluderMotion::kStraight)) {
    f.Numbers(
        "start_m", start_m,
        {.meaning = "position of the occluder at time 0 (straight only): x to the subject's left, "
                    "z to the direction that the subject faces first",
         .unit = "m",
         .origin = Origin::kInput});
    f.Numbers("velocity_m_s", velocity_m_s,
              {.meaning = "velocity of the occluder along x and z (straight only)",
               .unit = "m/s",
               .origin = Origin::kInput});
  }
  if (f.Applies(motion == OccluderMotion::kPath)) {
    f.List("path", path,
           {.meaning = "way points in the order of time (path only): straight between them, at the "
                       "first before and at the last after"});
  }
  f.Visit(presence);
}

std::string OccluderSettings::Problem() const {
  if (motion != OccluderMotion::kPath) return "";
  if (path.empty()) return "path: expected at least one way point, got none";
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (!(path[i - 1].time_s < path[i].time_s))
      return fmt::format(
          "path[{}].time_s: expected more than {:g} of the way point before, got {:g}", i,
          path[i - 1].time_s, path[i].time_s);
  }
  return "";
}

std::array<double, 2> PositionAt(const OccluderSettings& s, double time_s) {
  if (s.motion == OccluderMotion::kStraight)
    return {s.start_m[0] + time_s * s.velocity_m_s[0], s.start_m[1] + time_s * s.velocity_m_s[1]};
  const auto next = std::find_if(s.path.begin(), s.path.end(),
                                 [&](const WayPoint& point) { return point.time_s > time_s; });
  if (next == s.path.begin()) return s.path.front().position_m;
  if (next == s.path.end()) return s.path.back().position_m;
  const WayPoint& last = *std::prev(next);
  const double share = (time_s - last.time_s) / (next->time_s - last.time_s);
  return {std::lerp(last.position_m[0], next->position_m[0], share),
          std::lerp(last.position_m[1], next->position_m[1], share)};
}

void AddPost(const OccluderSettings& s, double time_s, const Rigidd& camera_from_subject,
             TriangleMesh& mesh) {
  const auto first = static_cast<int>(mesh.vertices.size());
  const auto [x, z] = PositionAt(s, time_s);
  const auto add = [&, x = x, z = z](double dx, double y, double dz) {
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
