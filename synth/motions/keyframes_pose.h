// A pose in anatomical angles (joint_limits.h), and its rotations.
#pragma once

#include <string>

#include "body/joint_limits.h"
#include "body/skeleton.h"
#include "config/settings.h"

namespace vitruvia {

enum Side : int { kLeft, kRight, kSideCount };

struct AnatomicalPose {
  std::array<double, kMidlineAngleCount> midline_deg{};
  std::array<std::array<double, kSideAngleCount>, kSideCount> sides_deg{};
};

// The same pose in a mirror: left and right change places.
AnatomicalPose Mirrored(const AnatomicalPose& pose);

// Fills in the rotation of every bone but the pelvis. A trunk's bend is shared evenly by abdomen
// and chest, a neck's by neck and head, a forearm's pronation by forearm and hand: no cross-section
// turns by more than half of it against its neighbour.
void SetRotations(const AnatomicalPose& pose, JointPose& joints);

// The angles that a key frame or a named pose of a motion file mentions.
struct MentionedAngles {
  MentionedAngles();

  std::array<double, kMidlineAngleCount> midline_deg;  // NaN: not mentioned
  std::array<std::array<double, kSideAngleCount>, kSideCount> sides_deg;
  std::array<double, kSideAngleCount> both_sides_deg;

  void Describe(Fields& fields);
  std::string Problem() const;  // an angle given twice
  void ApplyTo(AnatomicalPose& pose) const;
};

}  // namespace vitruvia
