// Which joints of a motion capture file are which of a human body's.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "body/skeleton.h"
#include "config/settings.h"
#include "synth/motions/mocap_clip.h"

namespace vitruvia {

// A user's word on one joint, which the table of rigs (mocap_rigs.h) does not know or has wrong.
struct MocapJointName {
  std::string file;  // the joint's name in the file
  std::string ours;  // a joint of the skeleton: left_wrist, …

  void Describe(Fields& fields);
  std::string Problem() const;
};

// Where a bone of ours takes its rotation from: `share` of the way from one joint's to another's.
struct MocapBoneSource {
  int from = 0, to = 0;
  double share = 0.0;
};

struct MocapJoints {
  std::string rig;  // the convention whose names the file has
  // The joints at which our bones begin; -1 for the spine's and neck's, which need not exist.
  std::array<int, kBoneCount> joints;
  std::array<MocapBoneSource, kBoneCount> sources;  // in the order of BoneId

  std::size_t At(BoneId bone) const {
    return static_cast<std::size_t>(joints[static_cast<std::size_t>(bone)]);
  }
};

// Limbs and head are found by name, as the table of rigs has them or `named` says, pelvis and chest
// as the joints from which legs and arms branch off, abdomen and neck between them. Both sides must
// have names of the same kind. DataError naming the file and what is missing or ambiguous.
MocapJoints FindMocapJoints(const MocapClip& clip, const std::vector<MocapJointName>& named = {});

}  // namespace vitruvia
