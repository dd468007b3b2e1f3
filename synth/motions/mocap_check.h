// Whether a clip looks like a human performer: limbs that keep their lengths, two equal sides, the
// head above the feet, knees that bend backwards, feet that point to the front, a root that goes
// where the feet carry it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "synth/motions/mocap_joints.h"

namespace vitruvia {

struct LimbLengths {
  const char* name;                            // of the limb's segment, without its side
  double left_m = 0.0, right_m = 0.0;          // means over the frames, scaled to the body
  double least_share = 1.0, most_share = 1.0;  // of the mean: over all frames, the worse side's
};

struct MocapCheck {
  std::array<LimbLengths, 4> limbs;         // upper arm, forearm, thigh, shin
  double trunk_m = 0.0;                     // from the hips to the head joint, mean
  double head_above_feet = 0.0;             // share of the frames
  int bent_knees = 0, knees_backwards = 0;  // knees (two per frame) that are clearly bent; of them
                                            // those that bend to the back
  double fastest_m_s = 0.0;                 // of the hips between two frames
  int fastest_frame = 0;                    // after which it was, from 0
  std::vector<std::string> warnings;        // whole sentences that name the file
};

// The clip is in the subject's axes (y up) and metres. DataError with the numbers if it cannot be
// that of a person: a limb without length, or whose length changes by more than half, or that is
// twice as long as the other side's, or hips that go a kilometre away or at 100 m/s all along.
MocapCheck CheckClip(const MocapClip& clip, const MocapJoints& joints);

}  // namespace vitruvia
