// From motion capture to a body's joint poses.
//
// Each bone takes its rotation from one joint: R(t) = G(t) A, with G the joint's rotation from the
// file's rest pose and A, constant, the smallest rotation from the bone's direction in our T-pose
// to its direction in the file's rest pose. So a limb points where the performer's limb points
// whatever the proportions, and the file's rest pose need not be a T-pose.
#pragma once

#include <memory>

#include "synth/motions/mocap_performer.h"
#include "synth/motions/motion.h"

namespace vitruvia {

// Samples are grounded: the body stands on the floor, and leaves it as far as the performer jumps.
std::unique_ptr<Motion> Retarget(const MocapPerformer& performer, const Skeleton& skeleton);

}  // namespace vitruvia
