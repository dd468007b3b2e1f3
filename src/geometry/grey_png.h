// Single-channel PNG files, in which depth and masks are stored. Include it only within geometry/,
// because it exposes OpenCV.
#pragma once

#include <filesystem>
#include <string>

#include <opencv2/core.hpp>

namespace vitruvia {

// `bits` is 8 or 16. DataError if the file is missing, damaged (also when cut short), has another
// number of bits or channels, or is not of the expected size.
cv::Mat ReadGreyPng(const std::filesystem::path& file, int bits, int width, int height);

void WriteGreyPng(const std::filesystem::path& file, const cv::Mat& raw);

// Decodes any image that OpenCV reads, without conversion. The result is empty if the image is
// damaged: libpng verifies all checksums and reports errors on standard error. DataError naming
// `where` if OpenCV throws.
cv::Mat DecodeImage(std::string& bytes, const std::string& where);

}  // namespace vitruvia
