#include "geometry/mask_png.h"

#include <algorithm>

#include "core/error.h"
#include "geometry/grey_png.h"

namespace vitruvia {

MaskImage ReadMaskPng(const std::filesystem::path& file, int width, int height) {
  const cv::Mat raw = ReadGreyPng(file, 8, width, height);
  MaskImage mask(width, height);
  for (int v = 0; v < height; ++v) std::copy_n(raw.ptr<std::uint8_t>(v), width, &mask(0, v));
  return mask;
}

void WriteMaskPng(const std::filesystem::path& file, const MaskImage& mask) {
  Require(!mask.empty(), "WriteMaskPng: image of {}×{} pixels, expected at least one", mask.width(),
          mask.height());
  cv::Mat raw(mask.height(), mask.width(), CV_8UC1);
  for (int v = 0; v < mask.height(); ++v) {
    std::copy_n(&mask(0, v), mask.width(), raw.ptr<std::uint8_t>(v));
  }
  WriteGreyPng(file, raw);
}

}  // namespace vitruvia
