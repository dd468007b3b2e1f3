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

// Evenly spaced colours of viridis and, for errors, of magma (van der Walt and Smith, 2015), whose
// last, black, would hide the shading.
Color DepthColor(double share) {
  static constexpr std::array<Color, 9> kColors = {{{0xfd, 0xe7, 0x25},
                                                    {0xad, 0xdc, 0x30},
                                                    {0x5e, 0xc9, 0x62},
                                                    {0x28, 0xae, 0x80},
                                                    {0x21, 0x91, 0x8c},
                                                    {0x2c, 0x72, 0x8e},
                                                    {0x3b, 0x52, 0x8b},
                                                    {0x47, 0x2d, 0x7b},
                                                    {0x44, 0x01, 0x54}}};
  return Interpolated(kColors, share);
}

Color ErrorColor(double share) {
  static constexpr std::array<Color, 8> kColors = {{{0xfc, 0xfd, 0xbf},
                                                    {0xfe, 0xc2, 0x87},
                                                    {0xfb, 0x87, 0x61},
                                                    {0xe5, 0x50, 0x64},
                                                    {0xb5, 0x36, 0x7a},
                                                    {0x81, 0x25, 0x81},
                                                    {0x4f, 0x12, 0x7b},
                                                    {0x1c, 0x10, 0x44}}};
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
