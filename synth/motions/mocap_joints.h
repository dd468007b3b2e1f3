// Which joints of a motion capture file are which of a human body's.
#pragma once

#include <array>

#include "body/skeleton.h"
#include "synth/motions/mocap_clip.h"

namespace vitruvia {

// Where a bone of ours takes its rotation from: `share` of the way from one joint's to another's.
struct MocapBoneSource {
  int from = 0, to = 0;
  double share = 0.0;
};

struct MocapJoints {
  // The joints at which our bones begin; -1 for the spine's and neck's, which need not exist.
  std::array<int, kBoneCount> joints;
  std::array<MocapBoneSource, kBoneCount> sources;  // in the order of BoneId
};

// Limbs and head are found by name, whatever the rig ("LeftUpLeg", "lfemur", "Bip01 L Thigh",
// "thigh.L", "LeftHip" …), pelvis and chest as the joints from which legs and arms branch off,
// abdomen and neck between them. DataError naming the file and what is missing.
MocapJoints FindMocapJoints(const MocapClip& clip);

}  // namespace vitruvia
