// A tapered capsule: all points within a radius of a segment; the radius varies linearly along it.
#pragma once

#include <vector>

#include "body/body_model.h"

namespace vitruvia::capsule_icp {

struct Capsule {
  int bone = 0;
  Vector3d start, end;  // of the segment, subject frame, rest pose, metres
  double start_radius_m = 0.0, end_radius_m = 0.0;
};

// The point of the segment whose sphere is nearest to x, at share t of the segment's length; the
// signed distance of x from the capsule, negative inside; and the outward direction at x.
struct CapsuleDistance {
  double t;
  double distance_m;
  Vector3d normal;
};
CapsuleDistance DistanceFrom(const Capsule& capsule, const Vector3d& x);

// Capsules that together fit the body's surface in the rest pose, least squares over its vertices
// by area: one for each bone, except that pelvis, abdomen and chest, which are wider than deep, get
// `trunk_capsules` (≥ 1) side by side. A bone that carries fewer than four vertices by more than
// half has no capsule, as the chest of learnt weights may have none. DataError if no bone has one.
std::vector<Capsule> FitCapsules(const BodyModel& body, int trunk_capsules);

}  // namespace vitruvia::capsule_icp
