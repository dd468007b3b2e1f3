// 16-bit PNG depth. A pixel's depth is value × unit_m; value 0 is "no measurement".
#pragma once

#include <filesystem>
#include <string>

#include "geometry/image.h"

namespace vitruvia {

// DataError if the file is missing, damaged (also when cut short), not 16-bit single-channel, or
// not of the expected size.
DepthImage ReadDepthPng(const std::filesystem::path& file, double unit_m, int width, int height);

// "" if every finite depth above 0 is 1 to 65535 units after rounding, the range of the file;
// otherwise the number of depths outside this range, and a suitable unit.
std::string DepthPngProblem(const DepthImage& depth, double unit_m);

// Depths that are negative or not finite become 0. std::invalid_argument with the message of
// DepthPngProblem if there is one.
void WriteDepthPng(const std::filesystem::path& file, const DepthImage& depth, double unit_m);

}  // namespace vitruvia
