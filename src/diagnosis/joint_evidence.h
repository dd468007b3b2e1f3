// What the stored data of a sequence says about each joint in each frame: what a tracker had to
// cope with there.
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
  double gap_m = 0.0;    // between the rest of the limb and the nearest other part of the body
  int pixels = 0;        // measured near the bone that hangs on the joint
  double noise_m = 0.0;  // standard deviation of depth there
};

// One frame: by bone; nothing where the sequence does not know the joint.
struct FrameEvidence {
  std::vector<std::optional<Vector3<double>>> truth;
  std::vector<JointEvidence> joints;
  int measured_pixels = 0;
};

// The thickness of a bone's flesh, from the subject's rest mesh, or of a usual body without one.
std::array<double, kBoneCount> BoneRadii(const SequenceReader& sequence);

// Of every frame; empty where the sequence has no true joints.
std::vector<FrameEvidence> GatherEvidence(const SequenceReader& sequence);

}  // namespace vitruvia
