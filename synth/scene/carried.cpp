#include "synth/scene/carried.h"

#include <fmt/format.h>

#include "math/rigid.h"
#include "synth/scene/box.h"

namespace vitruvia {

void CarriedSettings::Describe(Fields& f) {
  f.Text("bone", bone, {.meaning = "bone that carries a box, such as left_hand; empty: none does"});
  if (!f.Applies(IsThere())) return;
  f.Numbers("size_m", size_m,
            {.meaning = "width, height and depth of the box that a bone carries",
             .unit = "m",
             .min = 0.001,
             .max = 3.0});
  f.Numbers(
      "offset_m", offset_m,
      {.meaning = "middle of the carried box from the bone's joint in the rest pose: x to the "
                  "subject's left, y up, z to the front",
       .unit = "m",
       .min = -3.0,
       .max = 3.0});
  f.Visit(presence);
}

std::string CarriedSettings::Problem() const {
  if (bone.empty() || FindBone(bone) >= 0) return "";
  std::vector<std::string_view> names;
  for (const BoneInfo& info : Bones()) names.push_back(info.name);
  return fmt::format("bone \"{}\": expected one of {}", bone, fmt::join(names, ", "));
}

void AddCarried(const CarriedSettings& s, double time_s, const Skeleton& skeleton,
                const BoneTransforms& camera_from_rest, TriangleMesh& mesh) {
  if (!s.IsThere() || !s.presence.Holds(time_s)) return;
  const auto bone = static_cast<std::size_t>(FindBone(s.bone));
  const Vector3d middle =
      skeleton.joints[bone] + Vector3d(s.offset_m[0], s.offset_m[1], s.offset_m[2]);
  const Vector3d half = 0.5 * Vector3d(s.size_m[0], s.size_m[1], s.size_m[2]);
  AddBox(
      [&](const Vector3d& sides) {
        return camera_from_rest[bone] * (middle + sides.cwiseProduct(half)).eval();
      },
      mesh);
}

}  // namespace vitruvia
