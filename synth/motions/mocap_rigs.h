// Joint names of limbs in the rigs of common programs and data sets.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "body/skeleton.h"

namespace vitruvia {

// The joints that are found by name.
enum class LimbJoint { kShoulder, kElbow, kWrist, kHip, kKnee, kAnkle, kHead };
inline constexpr int kLimbJointCount = 7;

struct LimbJointInfo {
  const char* what;    // for messages
  BoneId left, right;  // the bones that begin there; equal on the midline
};
// In the order of LimbJoint.
const std::array<LimbJointInfo, kLimbJointCount>& LimbJoints();

// A convention: for each joint its names without the side, in lower case, letters and digits only;
// the first that a file has for both sides is taken. `mark` is a joint that distinguishes the
// convention from others with the same names, or "".
struct MocapRig {
  const char* name;
  std::string_view mark;
  std::array<std::vector<std::string_view>, kLimbJointCount> names;
};

// A file's convention is the first one of which it has all names. The last ones accept any mixture
// of names.
std::span<const MocapRig> MocapRigs();

}  // namespace vitruvia
