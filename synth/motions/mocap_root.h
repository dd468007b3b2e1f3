// Whether the path of a clip's root fits the limbs that hang on it.
#pragma once

#include <string>
#include <vector>

#include "synth/motions/mocap_joints.h"

namespace vitruvia {

// All in the subject's axes (y up) and metres; `poses` are those of the clip's frames. What is
// returned begins no sentence and names no file; "" where nothing is odd.

// The root's height above 0, where most files have the floor, is its height above the lowest joint
// but for a factor between two units of length.
std::string RootUnitDoubt(const MocapClip& clip, const MocapJoints& joints,
                          const std::vector<MocapPose>& poses);

// The root never moves, but the foot on which the performer stands does.
std::string FixedRootDoubt(const MocapClip& clip, const MocapJoints& joints,
                           const std::vector<MocapPose>& poses);

}  // namespace vitruvia
