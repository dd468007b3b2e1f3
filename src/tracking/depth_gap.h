// How far a posed model and a frame are apart in depth.
#pragma once

#include "geometry/image.h"

namespace vitruvia {

// Mean square (m²), over the pixels of `rendered` in every `stride`-th row and column, of the
// difference between rendered and measured depth. A difference counts at most 5 cm, and so does a
// pixel that only one of both images shows. Of two poses for one frame the right one has the lower
// gap whatever else the frame shows, and noise adds the same to both. 0 if nothing is rendered.
double SquaredDepthGap_m2(const DepthImage& rendered, const DepthImage& measured, int stride,
                          double max_depth_m);

}  // namespace vitruvia
