#include "reports/drawing/color_maps.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "reports/drawing/axis.h"

namespace vitruvia {
namespace {

// Linear between evenly spaced colours.
Color Interpolated(std::span<const Color> colors, double share) {
  const double position = std::clamp(share, 0.0, 1.0) * static_cast<double>(colors.size() - 1);
  const auto at = std::min(static_cast<std::size_t>(position), colors.size() - 2);
  const double t = position - static_cast<double>(at);
  Color color;
  for (std::size_t c = 0; c < color.size(); ++c) {
    color[c] =
        static_cast<std::uint8_t>(std::lround((1.0 - t) * colors[at][c] + t * colors[at + 1][c]));
  }
  return color;
}

}  // namespace

Color DepthColor(double share) {
  static constexpr std::array<Color, 5> kColors = {{{0xc8, 0x1e, 0x1e},
                                                    {0xf2, 0x8e, 0x2b},
                                                    {0xe8, 0xe0, 0x55},
                                                    {0x35, 0xb0, 0x9c},
                                                    {0x2a, 0x3f, 0xa8}}};
  return Interpolated(kColors, share);
}

Color ErrorColor(double share) {
  static constexpr std::array<Color, 6> kColors = {{{0xf3, 0xf0, 0xe4},
                                                    {0xfb, 0xd9, 0x7a},
                                                    {0xf5, 0x9a, 0x3c},
                                                    {0xdd, 0x4b, 0x25},
                                                    {0xa3, 0x14, 0x2e},
                                                    {0x4a, 0x04, 0x2c}}};
  return Interpolated(kColors, share);
}

Color BoneColor(int bone) {
  const double hue = std::fmod(0.618033988749895 * bone, 1.0) * 6.0;
  const auto channel = [hue](double offset) {
    const double k = std::fmod(offset + hue, 6.0);
    const double fall = std::clamp(std::min(k, 4.0 - k), 0.0, 1.0);
    return static_cast<std::uint8_t>(std::lround(255.0 * (0.92 - 0.55 * fall)));
  };
  return {channel(5.0), channel(3.0), channel(1.0)};
}

double ErrorScaleEnd(std::vector<double> errors, double smallest) {
  constexpr double kShareWithin = 0.98;
  if (errors.empty()) return smallest;
  const auto at =
      static_cast<std::ptrdiff_t>(kShareWithin * static_cast<double>(errors.size() - 1));
  std::nth_element(errors.begin(), errors.begin() + at, errors.end());
  return RoundedUp(std::max(errors[static_cast<std::size_t>(at)], smallest));
}

}  // namespace vitruvia
