// How well an imported person's masks agree with those of the synthetic scene that was imported.
#pragma once

#include "geometry/image.h"
#include "sequence/sequence.h"

namespace vitruvia {

// Over the pixels that are measured: shared / either.
double MaskOverlap(const MaskImage& mask, const MaskImage& truth, const DepthImage& depth);

// Distance of the farthest true pixel of a foot that was lost from what was kept, pixels; at most
// 8. A foot is what lies within 20 cm of an ankle.
double FeetLost_px(const SequenceReader& scene, int frame, const MaskImage& mask);

}  // namespace vitruvia
