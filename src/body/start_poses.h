// Poses in which a person may be met: starts for a search.
#pragma once

#include <array>
#include <span>

#include "body/anatomical_pose.h"

namespace vitruvia {

struct StartPose {
  const char* name;
  AnatomicalPose pose;
};

// Poses that are not symmetric come with their mirror images.
std::span<const StartPose> StartPoses();

// Poses of an arm and of a leg, spread over what each can do. Of the angles of a side, an arm has
// those from kShoulderFlexion up to kHipFlexion, a leg those from there on; the others are 0.
using SideAngles = std::array<double, kSideAngleCount>;
std::span<const SideAngles> ArmPoses();
std::span<const SideAngles> LegPoses();

}  // namespace vitruvia
