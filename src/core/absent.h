// How a number that does not exist, or was not measured, is held in memory. It is never a zero;
// files leave it out (config/stored_data.h).
#pragma once

#include <limits>

namespace vitruvia {

inline constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

}  // namespace vitruvia
