// Small versions of pictures.
#pragma once

#include "reports/drawing/color_image.h"

namespace vitruvia {

// The top of a picture at no more than `width` pixels, each the mean of those that fall into it,
// cut off below at `aspect` times its own width.
ColorImage Thumbnail(const ColorImage& image, int width, double aspect);

}  // namespace vitruvia
