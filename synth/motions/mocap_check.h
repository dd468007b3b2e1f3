// Checks that a clip is of a human performer: constant limb lengths, equal sides, the head above
// the feet, knees that bend backwards, feet that point to the front, and a root that moves
// consistently with the feet.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "synth/motions/mocap_joints.h"

namespace vitruvia {

struct LimbLengths {
  const char* name;                            // name of the limb's segment, without its side
  double left_m = 0.0, right_m = 0.0;          // means over the frames, scaled to the body
  double least_share = 1.0, most_share = 1.0;  // of the mean: over all frames, the worse side's
};

struct MocapCheck {
  std::array<LimbLengths, 4> limbs;         // upper arm, forearm, thigh, shin
  double trunk_m = 0.0;                     // from the hips to the head joint, mean
  double head_above_feet = 0.0;             // share of the frames
  int bent_knees = 0, knees_backwards = 0;  // number of clearly bent knees (two per frame), and of
                                            // those that bend backwards
  double fastest_m_s = 0.0;                 // of the hips between two frames
  int fastest_frame = 0;                    // after which it was, from 0
  std::vector<std::string> warnings;        // whole sentences that name the file
};

// The clip is in the subject's axes (y up) and metres. DataError with the numbers if the clip
// cannot be that of a person: a limb has no length, changes its length by more than half, or is
// twice as long as on the other side; or the hips are a kilometre away or move at 100 m/s
// throughout.
MocapCheck CheckClip(const MocapClip& clip, const MocapJoints& joints);

}  // namespace vitruvia
