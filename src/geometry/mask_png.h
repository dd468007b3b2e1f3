// 8-bit PNG masks: 0 = not the subject, anything else = the subject.
#pragma once

#include <filesystem>

#include "geometry/image.h"

namespace vitruvia {

// DataError if the file is missing, damaged (also when cut short), not 8-bit single-channel, or not
// of the expected size.
MaskImage ReadMaskPng(const std::filesystem::path& file, int width, int height);

void WriteMaskPng(const std::filesystem::path& file, const MaskImage& mask);

}  // namespace vitruvia
