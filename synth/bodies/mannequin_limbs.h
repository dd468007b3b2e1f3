// The shape of arms and legs: rings of six points about the limbs' axes.
#pragma once

#include <Eigen/Core>

#include "body/body_model.h"

namespace vitruvia::mannequin {

struct ArmJoints {
  Vector3d shoulder, elbow, wrist, finger_tip;
};
struct LegJoints {
  Vector3d hip, knee, ankle, toe_tip;
};

// Left limbs, metres, at the mean stature.
ArmJoints LeftArmJoints(Sex sex);
LegJoints LeftLegJoints(Sex sex, double girth_score);

// Arm rings, then the thumb (kArmRings × kRingPoints + kThumbPoints) × 3.
Eigen::MatrixX3d ArmPoints(Sex sex, double girth_score);
// Leg rings (kLegRings × kRingPoints) × 3.
Eigen::MatrixX3d LegPoints(Sex sex, double girth_score);

}  // namespace vitruvia::mannequin
