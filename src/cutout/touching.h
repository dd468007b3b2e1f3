// Separates people who touch, by their heads.
#pragma once

#include "cutout/pieces.h"

namespace vitruvia {

// Divides a piece that has several heads: each pixel goes to the nearest vertical line through a
// head, and every part must be large and tall enough for a person. A raised hand is rejected as a
// head because it, or the part that it would get, is too small. Pieces stay sorted by area.
void DivideTouchingPeople(const DepthImage& depth, const Room& room, const CutoutSettings& settings,
                          Pieces& pieces);

}  // namespace vitruvia
