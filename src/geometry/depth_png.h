// 16-bit PNG depth. A pixel's depth is value × unit_m; value 0 is "no measurement".
#pragma once

#include <filesystem>

#include "geometry/image.h"

namespace vitruvia {

// DataError if the file is missing, damaged (also when cut short), not 16-bit single-channel, or
// not of the expected size.
DepthImage ReadDepthPng(const std::filesystem::path& file, double unit_m, int width, int height);

// Depths beyond 65535 units become 0, as a sensor's out of range does; so do NaN and negatives.
void WriteDepthPng(const std::filesystem::path& file, const DepthImage& depth, double unit_m);

}  // namespace vitruvia
