// Small versions of pictures.
#pragma once

#include "reports/drawing/color_image.h"

namespace vitruvia {

// The top of a picture, downscaled by averaging to at most `width` pixels in width and cropped to a
// height of at most `aspect` times its width.
ColorImage Thumbnail(const ColorImage& image, int width, double aspect);

}  // namespace vitruvia
