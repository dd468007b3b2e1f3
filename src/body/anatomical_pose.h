// A pose in anatomical angles (joint_limits.h), and its rotations.
#pragma once

#include "body/joint_limits.h"
#include "body/skeleton.h"

namespace vitruvia {

enum Side : int { kLeft, kRight, kSideCount };

struct AnatomicalPose {
  std::array<double, kMidlineAngleCount> midline_deg{};
  std::array<std::array<double, kSideAngleCount>, kSideCount> sides_deg{};
};

// The mirrored pose: left and right are exchanged.
AnatomicalPose Mirrored(const AnatomicalPose& pose);

// Fills in the rotation of every bone but the pelvis. A trunk's bend is shared evenly by abdomen
// and chest, a neck's by neck and head, a forearm's pronation by forearm and hand: no two
// neighbouring cross-sections turn relative to each other by more than half of it.
void SetRotations(const AnatomicalPose& pose, JointPose& joints);

}  // namespace vitruvia
