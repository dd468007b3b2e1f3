// Maps the joints of a motion capture file to the skeleton's.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "body/skeleton.h"
#include "config/settings.h"
#include "synth/motions/mocap_clip.h"

namespace vitruvia {

// A joint named by the user, because the table of rigs (mocap_rigs.h) does not contain it or is
// wrong for the file.
struct MocapJointName {
  std::string file;  // the joint's name in the file
  std::string ours;  // a joint of the skeleton: left_wrist, …

  void Describe(Fields& fields);
  std::string Problem() const;
};

// Source of a bone's rotation: interpolation between the rotations of two joints by `share`.
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

// Limbs and head are found by name, from the table of rigs or `named`; pelvis and chest are the
// joints from which legs and arms branch off, with abdomen and neck between them. Both sides must
// have names of the same kind. DataError naming the file and what is missing or ambiguous.
MocapJoints FindMocapJoints(const MocapClip& clip, const std::vector<MocapJointName>& named = {});

}  // namespace vitruvia
