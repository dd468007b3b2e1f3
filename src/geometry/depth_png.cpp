#include "geometry/depth_png.h"

#include <cmath>
#include <limits>

#include "core/error.h"
#include "geometry/grey_png.h"

namespace vitruvia {

DepthImage ReadDepthPng(const std::filesystem::path& file, double unit_m, int width, int height) {
  Require(unit_m > 0.0, "ReadDepthPng: unit_m = {}, expected > 0", unit_m);
  const cv::Mat raw = ReadGreyPng(file, 16, width, height);
  DepthImage depth(width, height);
  for (int v = 0; v < height; ++v) {
    const auto* row = raw.ptr<std::uint16_t>(v);
    for (int u = 0; u < width; ++u) depth(u, v) = static_cast<float>(row[u] * unit_m);
  }
  return depth;
}

void WriteDepthPng(const std::filesystem::path& file, const DepthImage& depth, double unit_m) {
  Require(unit_m > 0.0, "WriteDepthPng: unit_m = {}, expected > 0", unit_m);
  Require(!depth.empty(), "WriteDepthPng: image of {}×{} pixels, expected at least one",
          depth.width(), depth.height());
  constexpr double kLargest = std::numeric_limits<std::uint16_t>::max();
  cv::Mat raw(depth.height(), depth.width(), CV_16UC1);
  for (int v = 0; v < depth.height(); ++v) {
    auto* row = raw.ptr<std::uint16_t>(v);
    for (int u = 0; u < depth.width(); ++u) {
      const double units = std::round(depth(u, v) / unit_m);
      row[u] = units >= 0.0 && units <= kLargest ? static_cast<std::uint16_t>(units) : 0;
    }
  }
  WriteGreyPng(file, raw);
}

}  // namespace vitruvia
