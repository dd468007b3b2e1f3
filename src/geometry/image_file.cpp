#include "geometry/image_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <string>
#include <string_view>

#include <opencv2/imgcodecs.hpp>

#include "core/error.h"
#include "core/files.h"
#include "geometry/grey_png.h"

namespace vitruvia {
namespace {

constexpr std::array<std::string_view, 5> kEndings{".png", ".pgm", ".tif", ".tiff", ".exr"};

std::string EndingOf(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

// OpenCV reads OpenEXR only if this variable is set before its first use.
void AllowOpenExr() {
  static const int done = setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 0);
  static_cast<void>(done);
}

std::string NumbersOf(const cv::Mat& image) {
  const bool is_whole = image.depth() != CV_32F && image.depth() != CV_64F;
  return fmt::format("{}-bit {} numbers", 8 * image.elemSize1(),
                     is_whole ? "whole" : "floating-point");
}

}  // namespace

bool IsImageFile(const std::filesystem::path& file) {
  return std::find(kEndings.begin(), kEndings.end(), EndingOf(file)) != kEndings.end();
}

StoredImage ReadImageFile(const std::filesystem::path& file) {
  const std::string where = file.string();
  std::string bytes = ReadWholeFile(file);
  AllowOpenExr();
  const cv::Mat raw = bytes.empty() ? cv::Mat() : DecodeImage(bytes, where);
  if (raw.empty()) {
    throw DataError(fmt::format(
        "{}: expected a PNG, PGM, TIFF or OpenEXR image, but its {} bytes cannot be decoded; is it "
        "cut short?",
        where, bytes.size()));
  }
  if (raw.channels() != 1) {
    throw DataError(fmt::format(
        "{}: expected one channel of depth, found {} channels of {} bits; is it a colour image?",
        where, raw.channels(), 8 * raw.elemSize1()));
  }
  Image<float> image(raw.cols, raw.rows);
  cv::Mat values(raw.rows, raw.cols, CV_32FC1, image.pixels().data());
  raw.convertTo(values, CV_32F);
  return {std::move(image), NumbersOf(raw)};
}

}  // namespace vitruvia
