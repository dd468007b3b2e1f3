// Point samples and meshes of the capsules' surface.
#pragma once

#include "methods/capsule_icp/capsule.h"

namespace vitruvia::capsule_icp {

// A point of the surface and its bone; subject frame, rest pose.
struct SurfaceSample {
  int bone;
  Vector3d place;
};

// Samples, about `spacing_m` apart, of the capsules' surface outside all other capsules.
std::vector<SurfaceSample> SampleCapsules(const std::vector<Capsule>& capsules, double spacing_m);

// A closed mesh of each capsule, with `corners` vertices round its axis, and the bone of each
// vertex.
struct CapsuleMesh {
  TriangleMesh mesh;
  std::vector<int> bones;
};
CapsuleMesh Meshed(const std::vector<Capsule>& capsules, int corners);

}  // namespace vitruvia::capsule_icp
