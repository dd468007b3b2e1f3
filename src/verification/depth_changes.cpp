#include "verification/depth_changes.h"

#include <cmath>
#include <cstdint>

namespace vitruvia {
namespace {

// The image whose pixel (u, v) is `value(u, v)`.
template <class Value>
DepthImage ImageOf(const DepthImage& like, const Value& value) {
  DepthImage image(like.width(), like.height());
  for (int v = 0; v < like.height(); ++v) {
    for (int u = 0; u < like.width(); ++u) image(u, v) = value(u, v);
  }
  return image;
}

}  // namespace

DepthImage WithSwappedBytes(const DepthImage& depth, double unit_m) {
  return ImageOf(depth, [&](int u, int v) {
    const auto value = static_cast<std::uint32_t>(std::lround(depth(u, v) / unit_m));
    return static_cast<float>((((value & 0xffu) << 8) | ((value >> 8) & 0xffu)) * unit_m);
  });
}

DepthImage MirroredSideways(const DepthImage& depth) {
  return ImageOf(depth, [&](int u, int v) { return depth(depth.width() - 1 - u, v); });
}

DepthImage TurnedUpsideDown(const DepthImage& depth) {
  return ImageOf(depth, [&](int u, int v) { return depth(u, depth.height() - 1 - v); });
}

DepthImage TurnedHalfRound(const DepthImage& depth) {
  return TurnedUpsideDown(MirroredSideways(depth));
}

DepthImage Scaled(const DepthImage& depth, double factor) {
  return ImageOf(depth, [&](int u, int v) { return static_cast<float>(depth(u, v) * factor); });
}

DepthImage FromRayLengths(const DepthImage& lengths, const PinholeCamera& camera) {
  return ImageOf(lengths, [&](int u, int v) {
    return static_cast<float>(lengths(u, v) / camera.Unproject<double>(u, v, 1.0).norm());
  });
}

}  // namespace vitruvia
