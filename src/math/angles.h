// Angles are in radians in the code, and in degrees in settings and files that people write.
#pragma once

#include <numbers>

namespace vitruvia {

inline constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

}  // namespace vitruvia
