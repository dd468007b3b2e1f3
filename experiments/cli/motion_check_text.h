// Text that describes how a motion capture file is interpreted.
#pragma once

#include <string>

#include "synth/motions/mocap_performer.h"

namespace vitruvia {

// Rig, joints, rate, axes, scale and lengths, a line each.
std::string DescribePerformer(const MocapPerformer& performer);

}  // namespace vitruvia
