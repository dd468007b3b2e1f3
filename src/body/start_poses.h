// Poses in which a person may be met: starts for a search.
#pragma once

#include <span>

#include "body/anatomical_pose.h"

namespace vitruvia {

struct StartPose {
  const char* name;
  AnatomicalPose pose;
};

// Poses that are not symmetric come with their mirror images.
std::span<const StartPose> StartPoses();

}  // namespace vitruvia
