// Angles are radians inside; files and settings that are written by people hold degrees.
#pragma once

#include <numbers>

namespace vitruvia {

inline constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

}  // namespace vitruvia
