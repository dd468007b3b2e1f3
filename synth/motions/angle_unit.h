// Checks of the unit of a motion file's angles.
#pragma once

#include <string>

namespace vitruvia {

// Warning for a motion whose angles, read as degrees, reach at most this size; "" if all are zero,
// or if one is larger than any angle in radians.
std::string DegreesDoubt(double largest_deg);

// The same for angles read as radians.
std::string RadiansDoubt(double largest_rad);

}  // namespace vitruvia
