// A body cut along its bones into closed rigid pieces.
#pragma once

#include <vector>

#include "body/body_model.h"

namespace vitruvia::sdf_parts {

// The part of the skin that belongs to a bone, with caps where it was cut from its neighbours. Rest
// pose, subject frame, metres; closed and oriented outwards.
struct Part {
  int bone = 0;
  TriangleMesh mesh;
};

// One part for each bone: the triangles that follow it by at least `least_weight` on average. With
// less than one half, neighbouring parts overlap, so that a bent joint shows no gap. DataError if a
// bone carries no triangle.
std::vector<Part> CutIntoParts(const BodyModel& body, double least_weight);

}  // namespace vitruvia::sdf_parts
