// Where there is no rig: the pieces of a surface that move most nearly rigidly.
#pragma once

#include "learning/skinning/examples.h"
#include "learning/skinning/labels.h"

namespace vitruvia::skinning {

// Labels for `count` (1 … 256) pieces: from one piece on, the worst is split at its worst vertex,
// and all vertices go over to the piece that moves them best, in turn (as Le & Deng 2012, sec. 4.1,
// start). Deterministic; a piece may end up empty if fewer move differently. Misuse if
// ExamplesProblem() has a complaint.
Labels FindRigidPieces(const Examples& examples, int count, int threads);

}  // namespace vitruvia::skinning
