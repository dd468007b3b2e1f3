#include "geometry/depth_png.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "geometry/grey_png.h"

namespace vitruvia {
namespace {

constexpr double kLargest = std::numeric_limits<std::uint16_t>::max();

}  // namespace

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

std::string DepthPngProblem(const DepthImage& depth, double unit_m) {
  long measured = 0, outside = 0;
  float least_m = std::numeric_limits<float>::infinity(), most_m = 0.0f;
  for (const float z : depth.pixels()) {
    if (!(z > 0.0f) || !std::isfinite(z)) continue;
    ++measured;
    const double units = z / unit_m;
    if (units >= 0.5 && units < kLargest + 0.5) continue;
    ++outside;
    least_m = std::min(least_m, z);
    most_m = std::max(most_m, z);
  }
  if (outside == 0) return "";
  const bool is_too_deep = std::round(most_m / unit_m) > kLargest;
  return fmt::format(
      "{} of {} measured pixels, {:.4g} to {:.4g} m deep, do not fit 16 bits: with a depth_unit_m "
      "of {:g} m these hold {:.4g} to {:.4g} m; expected a depth_unit_m of at {} {:.3g} m",
      outside, measured, least_m, most_m, unit_m, unit_m, kLargest * unit_m,
      is_too_deep ? "least" : "most", is_too_deep ? most_m / kLargest : least_m);
}

void WriteDepthPng(const std::filesystem::path& file, const DepthImage& depth, double unit_m) {
  Require(unit_m > 0.0, "WriteDepthPng: unit_m = {}, expected > 0", unit_m);
  Require(!depth.empty(), "WriteDepthPng: image of {}×{} pixels, expected at least one",
          depth.width(), depth.height());
  const std::string problem = DepthPngProblem(depth, unit_m);
  Require(problem.empty(), "WriteDepthPng: {}", problem);
  cv::Mat raw(depth.height(), depth.width(), CV_16UC1);
  for (int v = 0; v < depth.height(); ++v) {
    auto* row = raw.ptr<std::uint16_t>(v);
    for (int u = 0; u < depth.width(); ++u) {
      const double units = depth(u, v) / unit_m;
      row[u] = units > 0.0 && std::isfinite(units)
                   ? static_cast<std::uint16_t>(std::floor(units + 0.5))
                   : 0;
    }
  }
  WriteGreyPng(file, raw);
}

}  // namespace vitruvia
