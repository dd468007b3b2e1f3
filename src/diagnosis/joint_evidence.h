// Conditions of each joint in each frame (visibility, motion, noise), from the stored data of a
// sequence.
#pragma once

#include <optional>
#include <vector>

#include "body/skeleton.h"
#include "math/vector.h"
#include "sequence/sequence.h"

namespace vitruvia {

// Of one joint in one frame.
struct JointEvidence {
  bool in_view = true;
  bool visible = true;
  double step_m = 0.0;   // from the frame before; 0 in the first
  double gap_m = 0.0;    // distance between the rest of the limb and the nearest other part of the
                         // body
  int pixels = 0;        // measured pixels near the bone distal to the joint
  double noise_m = 0.0;  // standard deviation of depth at these pixels
};

// One frame, by bone; no truth where the sequence does not know the joint.
struct FrameEvidence {
  std::vector<std::optional<Vector3<double>>> truth;
  std::vector<JointEvidence> joints;
  int measured_pixels = 0;
};

// Radius of the body about each bone, metres, from the subject's rest mesh, or of an average body
// if the sequence has no subject.
std::array<double, kBoneCount> BoneRadii(const SequenceReader& sequence);

// Evidence of every frame; empty if the sequence has no true joints.
std::vector<FrameEvidence> GatherEvidence(const SequenceReader& sequence);

}  // namespace vitruvia
