// Removal of flying pixels: measurements between two surfaces, at edges of depth.
#pragma once

#include "geometry/image.h"

namespace vitruvia {

// Copies the measurements that at least `least_neighbors` of the eight pixels round them support by
// a depth within `within_m`; the other pixels of `kept` are 0. A straight edge leaves a pixel five
// neighbours on its own surface, a right-angled corner three; a line one pixel wide leaves two.
void RemoveFlyingPixels(const DepthImage& depth, int least_neighbors, float within_m,
                        DepthImage& kept);

}  // namespace vitruvia
