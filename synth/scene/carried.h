// A box that a limb carries: it moves with the bone and occludes what is behind it.
#pragma once

#include <array>
#include <string>

#include "body/skeleton.h"
#include "synth/scene/occluder.h"

namespace vitruvia {

struct CarriedSettings {
  std::string bone;  // "": nothing is carried
  std::array<double, 3> size_m{0.3, 0.3, 0.3};
  std::array<double, 3> offset_m{0.0, 0.0, 0.0};  // of the box's middle from the bone's joint
  Presence presence;

  bool IsThere() const { return !bone.empty(); }
  void Describe(Fields& fields);
  std::string Problem() const;
};

// Adds the box as the bone carries it at that time to a mesh in the camera frame, metres.
void AddCarried(const CarriedSettings& settings, double time_s, const Skeleton& skeleton,
                const BoneTransforms& camera_from_rest, TriangleMesh& mesh);

}  // namespace vitruvia
