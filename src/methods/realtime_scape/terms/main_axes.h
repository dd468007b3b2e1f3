// The bones that rotate only about a main axis (paper A, section 6.1).
#pragma once

#include <array>

#include "body/skeleton.h"

namespace vitruvia::realtime_scape {

struct MainAxis {
  BoneId bone;
  Vector3<double> axis;  // subject frame, rest pose, unit length
};

// Guessed (the paper draws one axis and lists the bones): in the T-pose with palms down an elbow
// bends about the vertical, knees and ankles about the left-right axis; a head turns about the
// vertical.
const std::array<MainAxis, 7>& MainAxes();

}  // namespace vitruvia::realtime_scape
