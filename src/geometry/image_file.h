// Single-channel images written by other programs: the stored numbers, without a unit.
#pragma once

#include <filesystem>

#include "geometry/image.h"

namespace vitruvia {

// PNG, PGM, TIFF and OpenEXR files of 8, 16 or 32 bits, whole numbers or floating point.
bool IsImageFile(const std::filesystem::path& file);

// The stored numbers, including NaN and infinities. DataError naming the file if it is missing,
// damaged, or has more than one channel.
Image<float> ReadImageFile(const std::filesystem::path& file);

}  // namespace vitruvia
