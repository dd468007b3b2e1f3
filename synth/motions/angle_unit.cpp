#include "synth/motions/angle_unit.h"

#include <numbers>

#include <fmt/format.h>

namespace vitruvia {
namespace {

// If no joint rotates by more than this, the motion is static or its angles are not in degrees.
constexpr double kSmallestTurnDeg = 4.0;
constexpr double kMostTurns = 4.0;  // in an angle: more are radians that are degrees

}  // namespace

std::string DegreesDoubt(double largest_deg) {
  if (!(largest_deg > 0.0) || largest_deg >= kSmallestTurnDeg) return "";
  return fmt::format("no angle is larger than {:.2f} degrees: are they radians?", largest_deg);
}

std::string RadiansDoubt(double largest_rad) {
  if (largest_rad <= 2.0 * std::numbers::pi * kMostTurns) return "";
  return fmt::format("the largest angle is {:.4g} radians: are they degrees?", largest_rad);
}

}  // namespace vitruvia
