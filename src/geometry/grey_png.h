// PNG files of one channel: what depth and masks are stored in. For geometry's own files only,
// since it shows OpenCV.
#pragma once

#include <filesystem>

#include <opencv2/core.hpp>

namespace vitruvia {

// `bits` is 8 or 16. DataError if the file is missing, damaged (also when cut short), has another
// number of bits or channels, or is not of the expected size.
cv::Mat ReadGreyPng(const std::filesystem::path& file, int bits, int width, int height);

void WriteGreyPng(const std::filesystem::path& file, const cv::Mat& raw);

}  // namespace vitruvia
