// Images of one channel as other programs write them, by the ending of the name.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "geometry/image.h"

namespace vitruvia {

// `type`: OpenCV's, of the stored numbers; whole numbers are rounded and must fit.
inline void WriteImageFile(const std::filesystem::path& file, const Image<float>& image, int type) {
  setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 0);  // before OpenCV's first use of the format
  cv::Mat values(image.height(), image.width(), CV_32FC1), stored;
  std::copy(image.pixels().begin(), image.pixels().end(), values.begin<float>());
  values.convertTo(stored, type);
  ASSERT_TRUE(cv::imwrite(file.string(), stored)) << file;
}

}  // namespace vitruvia
