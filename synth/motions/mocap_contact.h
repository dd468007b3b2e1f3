// Height of a performer above the floor.
#pragma once

#include "synth/motions/mocap_joints.h"

namespace vitruvia {

// From the axes of a foot that stands flat to those of the file's rest pose. A rest pose with legs
// apart is taken to have tilted the feet with their shins.
Matrix3<double> RestFromFlatFoot(const Vector3<double>& shin_direction_at_rest);

// For each frame the height of the performer's lowest point above the floor, metres; 0 within the
// noise of the markers. The clip is in the subject's axes (y up) and metres. Captured floors slope
// by some centimetres over a room, so the floor's height is estimated locally along the clip, on
// the assumption that nobody is in the air for as long as a second.
std::vector<double> Clearances(const MocapClip& clip, const MocapJoints& joints,
                               double leg_length_m);

}  // namespace vitruvia
