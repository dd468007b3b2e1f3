// Likely causes of an error, from a ratio or from a change of axes that would correct it.
#pragma once

#include <string>
#include <vector>

#include "math/vector.h"

namespace vitruvia {

// "1000 times too large" for a length or depth that is `ratio` times what is expected.
std::string TimesTooLarge(double ratio);

// A question to append to TimesTooLarge: ": in millimetres?"; "" if the ratio matches no known
// unit.
std::string LengthUnitCause(double ratio);

// A question about the header's depth_unit_m, given that depth is `ratio` times what is expected.
std::string DepthUnitCause(double ratio, double depth_unit_m);

// A signed permutation of the axes other than the identity.
struct AxisMap {
  Matrix3<double> expected_from_file;
};

const std::vector<AxisMap>& AxisMaps();  // all 47

enum class AxesOf { kCamera, kSubject };
// The axes of a file that `map` corrects: "y up and z backwards instead of y down and z forward".
std::string AxisCause(const AxisMap& map, AxesOf frame);

}  // namespace vitruvia
