// A small body for tests: boxes for limbs, 17 bones, one closed manifold, made in a millisecond.
#pragma once

#include "body/body_model.h"

namespace vitruvia {

// A figure of boxes, 1.75 m tall, in the T-pose of body/skeleton.h: subject frame, soles on y = 0,
// left and right mirror images. Every limb is cut into `cells_per_segment` cells along each axis
// (≥ 1). Vertices follow the bone of the cells that they belong to; those between two bones follow
// both by half.
BodyModel TinyBody(int cells_per_segment = 1);

}  // namespace vitruvia
