// What was understood of a motion capture file, in words.
#pragma once

#include <string>

#include "synth/motions/mocap_performer.h"

namespace vitruvia {

// Rig, joints, rate, axes, scale and lengths, a line each.
std::string DescribePerformer(const MocapPerformer& performer);

}  // namespace vitruvia
