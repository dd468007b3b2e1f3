// Spatially correlated noise.
#pragma once

#include "geometry/image.h"

namespace vitruvia {

// Sums independent standard normal draws over the square window of width_px round each pixel, and
// scales them back to deviation 1. Correlation falls linearly to 0 at width_px columns or rows; its
// sum over all pixels is width_px², the area of one independent sample. With width 1 the draws are
// unchanged.
Image<double> SharedNoise(const Image<double>& draws, int width_px);

}  // namespace vitruvia
