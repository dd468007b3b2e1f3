// Small versions of PNG files.
#pragma once

#include <filesystem>

#include "reports/drawing/offscreen.h"

namespace vitruvia {

// DataError if the file is not a PNG.
ColorImage ReadPng(const std::filesystem::path& file);

// The top of a picture at no more than `width` pixels, each the mean of those that fall into it,
// cut off below at `aspect` times its own width.
ColorImage Thumbnail(const ColorImage& image, int width, double aspect);

}  // namespace vitruvia
