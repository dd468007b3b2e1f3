// People who touch, told apart by their heads.
#pragma once

#include "cutout/pieces.h"

namespace vitruvia {

// Divides each piece from which several heads stick out among the upright lines through them, if
// every part is large and tall enough for a person. A raised hand is no head where it is too thin,
// or where what would be its part is. Pieces stay sorted by area.
void DivideTouchingPeople(const DepthImage& depth, const Room& room, const CutoutSettings& settings,
                          Pieces& pieces);

}  // namespace vitruvia
