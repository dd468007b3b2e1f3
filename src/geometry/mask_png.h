// 8-bit PNG masks: 0 = not the subject, anything else = the subject; kForeignDepthMask = the
// subject, but the pixel holds the depth of something else.
#pragma once

#include <cstdint>
#include <filesystem>

#include "geometry/image.h"

namespace vitruvia {

inline constexpr std::uint8_t kSubjectMask = 255, kForeignDepthMask = 128;

// DataError if the file is missing, damaged (also when cut short), not 8-bit single-channel, or not
// of the expected size.
MaskImage ReadMaskPng(const std::filesystem::path& file, int width, int height);

void WriteMaskPng(const std::filesystem::path& file, const MaskImage& mask);

}  // namespace vitruvia
