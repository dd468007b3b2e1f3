// Typical poses of a person, used as starts of a pose search.
#pragma once

#include <array>
#include <span>

#include "body/anatomical_pose.h"

namespace vitruvia {

struct StartPose {
  const char* name;
  AnatomicalPose pose;
};

// The list contains the mirror image of every pose that is not symmetric.
std::span<const StartPose> StartPoses();

// Poses of an arm and of a leg, spread over their ranges of motion. Of a side's angles, an arm's
// are those from kShoulderFlexion up to but not including kHipFlexion, and a leg's are those from
// kHipFlexion on; the others are 0.
using SideAngles = std::array<double, kSideAngleCount>;
std::span<const SideAngles> ArmPoses();
std::span<const SideAngles> LegPoses();

}  // namespace vitruvia
