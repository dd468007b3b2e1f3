#include "synth/scene/room.h"

#include <cmath>
#include <numbers>

#include "math/rigid.h"
#include "synth/scene/box.h"

namespace vitruvia {
namespace {

constexpr double kExtent_m = 15.0;  // of floor and walls to all sides: beyond what a camera sees

void AddFurniture(const FurnitureSettings& box, const Rigidd& camera_from_subject,
                  TriangleMesh& mesh) {
  const double turn = box.turn_deg * std::numbers::pi / 180.0;
  AddBox(
      [&](const Vector3d& sides) -> Vector3d {
        const double x = 0.5 * sides.x() * box.size_m[0];
        const double y = box.base_m + (sides.y() > 0.0 ? box.size_m[1] : 0.0);
        const double z = 0.5 * sides.z() * box.size_m[2];
        return camera_from_subject *
               Vector3d(box.position_m[0] + std::cos(turn) * x + std::sin(turn) * z, y,
                        box.position_m[1] - std::sin(turn) * x + std::cos(turn) * z);
      },
      mesh);
}

}  // namespace

void FurnitureSettings::Describe(Fields& f) {
  f.Numbers("position_m", position_m,
            {.meaning = "middle of the box on the floor: x to the subject's left, z to the "
                        "direction that the subject faces first",
             .unit = "m",
             .min = -15.0,
             .max = 15.0});
  f.Numbers(
      "size_m", size_m,
      {.meaning = "width, height and depth of the box", .unit = "m", .min = 0.001, .max = 15.0});
  f.Number("base_m", base_m,
           {.meaning = "height of the box's lower side above the floor",
            .unit = "m",
            .min = 0.0,
            .max = 5.0});
  f.Number("turn_deg", turn_deg,
           {.meaning = "turn of the box about the vertical, to the left",
            .unit = "deg",
            .min = -360.0,
            .max = 360.0});
}

void RoomSettings::Describe(Fields& f) {
  f.Flag("floor", floor, {.meaning = "whether there is a floor"});
  f.Number("wall_behind_m", wall_behind_m,
           {.meaning = "distance of a wall behind the subject's start; 0: no wall",
            .unit = "m",
            .min = 0.0,
            .max = 15.0});
  f.Number("wall_left_m", wall_left_m,
           {.meaning = "distance of a wall at the subject's left; 0: no wall",
            .unit = "m",
            .min = 0.0,
            .max = 15.0});
  f.Number("wall_right_m", wall_right_m,
           {.meaning = "distance of a wall at the subject's right; 0: no wall",
            .unit = "m",
            .min = 0.0,
            .max = 15.0});
  f.Number("wall_height_m", wall_height_m,
           {.meaning = "height of the walls", .unit = "m", .min = 0.1, .max = 10.0});
  f.List("furniture", furniture, {.meaning = "boxes that stand in the room"});
  f.Integer("empty_frames", empty_frames,
            {.meaning = "frames of the empty room that are stored beside the sequence, for cutting "
                        "out the person",
             .min = 0,
             .max = 1000});
}

TriangleMesh RoomMesh(const RoomSettings& s, const Rigidd& camera_from_subject) {
  TriangleMesh mesh;
  const auto add = [&](const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
    AddQuad(camera_from_subject * a, camera_from_subject * b, camera_from_subject * c,
            camera_from_subject * d, mesh);
  };
  const double far = kExtent_m, top = s.wall_height_m;
  const double left = s.wall_left_m, right = -s.wall_right_m, back = -s.wall_behind_m;
  if (s.floor) add({-far, 0, -far}, {-far, 0, far}, {far, 0, far}, {far, 0, -far});
  if (s.wall_behind_m > 0.0)
    add({-far, 0, back}, {far, 0, back}, {far, top, back}, {-far, top, back});
  if (s.wall_left_m > 0.0)
    add({left, 0, -far}, {left, 0, far}, {left, top, far}, {left, top, -far});
  if (s.wall_right_m > 0.0)
    add({right, 0, far}, {right, 0, -far}, {right, top, -far}, {right, top, far});
  for (const FurnitureSettings& box : s.furniture) AddFurniture(box, camera_from_subject, mesh);
  return mesh;
}

}  // namespace vitruvia
