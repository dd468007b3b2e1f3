// PNG files of one channel: what depth and masks are stored in. For geometry's own files only,
// since it shows OpenCV.
#pragma once

#include <filesystem>
#include <string>

#include <opencv2/core.hpp>

namespace vitruvia {

// `bits` is 8 or 16. DataError if the file is missing, damaged (also when cut short), has another
// number of bits or channels, or is not of the expected size.
cv::Mat ReadGreyPng(const std::filesystem::path& file, int bits, int width, int height);

void WriteGreyPng(const std::filesystem::path& file, const cv::Mat& raw);

// Any image that OpenCV reads, as it is stored. Empty if it is damaged: libpng holds all check sums
// against the data and says on standard error what is wrong. DataError naming `where` if OpenCV
// gives a reason.
cv::Mat DecodeImage(std::string& bytes, const std::string& where);

}  // namespace vitruvia
