// Whether the angles of a motion file are in the unit that they are taken for.
#pragma once

#include <string>

namespace vitruvia {

// What is odd about a motion whose angles are taken to be degrees and reach this size; "" if
// nothing: all of them zero, or one that is larger than any angle in radians.
std::string DegreesDoubt(double largest_deg);

// The same for angles that are taken to be radians.
std::string RadiansDoubt(double largest_rad);

}  // namespace vitruvia
