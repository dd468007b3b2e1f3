// Checks whether the path of a clip's root is consistent with its limbs.
#pragma once

#include <string>
#include <vector>

#include "synth/motions/mocap_joints.h"

namespace vitruvia {

// All in the subject's axes (y up) and metres; `poses` are those of the clip's frames. The
// functions return part of a sentence that does not name the file, or "" if there is no doubt.

// Doubt if the root's height above 0, the floor of most files, differs from its height above the
// lowest joint by the ratio of two units of length.
std::string RootUnitDoubt(const MocapClip& clip, const MocapJoints& joints,
                          const std::vector<MocapPose>& poses);

// Doubt if the root never moves, but the supporting foot does.
std::string FixedRootDoubt(const MocapClip& clip, const MocapJoints& joints,
                           const std::vector<MocapPose>& poses);

}  // namespace vitruvia
