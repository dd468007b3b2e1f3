// Segments a surface without a rig into nearly rigid pieces.
#pragma once

#include "learning/skinning/examples.h"
#include "learning/skinning/labels.h"

namespace vitruvia::skinning {

// Labels for `count` (1 … 256) pieces: starting from one piece, the piece with the largest error is
// split at its worst vertex, and then all vertices are reassigned to the piece that fits them best,
// and so on (initialisation of Le & Deng 2012, sec. 4.1). Deterministic. A piece may be empty if
// fewer pieces move differently. std::invalid_argument if ExamplesProblem() reports a problem.
Labels FindRigidPieces(const Examples& examples, int count, int threads);

}  // namespace vitruvia::skinning
