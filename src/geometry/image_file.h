// Single-channel images written by other programs: the stored numbers, without a unit.
#pragma once

#include <filesystem>
#include <string>

#include "geometry/image.h"

namespace vitruvia {

// PNG, PGM, TIFF and OpenEXR files of 8, 16 or 32 bits, whole numbers or floating point.
bool IsImageFile(const std::filesystem::path& file);

struct StoredImage {
  Image<float> values;
  std::string numbers;  // how a file stores them, for people: "16-bit whole numbers"
};

// The stored numbers, including NaN and infinities. DataError naming the file if it is missing,
// damaged, or has more than one channel.
StoredImage ReadImageFile(const std::filesystem::path& file);

}  // namespace vitruvia
