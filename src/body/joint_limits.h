// Anatomical joint angles: their names, signs and the ranges of healthy adults.
//
// All angles are zero in the neutral standing position: upright, arms hanging, palms towards the
// thighs, feet forward. (The rest pose of a skeleton, the T-pose, is therefore not zero but both
// shoulders abducted by 90 degrees.) Every angle is positive for the motion that it is named after,
// on both sides of the body:
//
//   spine, neck      flexion_deg            bends forward
//                    bend_left_deg          bends sideways, towards the subject's left
//                    turn_left_deg          turns to the subject's left
//   shoulder, hip    flexion_deg            brings the limb forward and up; extension is negative
//                    abduction_deg          brings the limb away from the body sideways
//                    internal_rotation_deg  turns the limb about its own axis, front to the middle
//   elbow            flexion_deg            brings the hand towards the shoulder
//                    pronation_deg          turns the forearm: palm of a hanging hand to the back
//   wrist            flexion_deg            bends towards the palm; extension is negative
//                    ulnar_deviation_deg    bends towards the little finger
//   knee             flexion_deg            brings the heel towards the seat
//   ankle            dorsiflexion_deg       lifts the toes; plantar flexion is negative
//                    inversion_deg          turns the sole towards the other foot
//
// Shoulder and hip: flexion f and abduction a are the two components of one swing. The hanging limb
// swings about a single horizontal axis by sqrt(f² + a²), towards the front by the share f and
// sideways by the share a; the axial rotation follows about the limb's own axis. So (90, 0) points
// forward, (0, 90) sideways, (64, 64) between the two, (90, −40) across the chest, and (0, 180) or
// (180, 0) straight up (with the elbow's crease turned by 180 degrees between the two: Codman's
// paradox). The map is smooth everywhere short of a swing of 360 degrees, hence any interpolation
// of the angles is a smooth motion; Euler angles of a shoulder are singular within its range.
//
// Spine, neck, wrist and ankle: the angles are the components of one rotation vector.
#pragma once

#include <array>
#include <span>

namespace vitruvia {

struct AngleInfo {
  const char* key;  // as in a motion file
  const char* meaning;
  double min_deg, max_deg;
  const char* source;  // of the range
};

struct JointInfo {
  const char* name;    // "spine"; of a joint that exists twice: "knee" in "left_knee", "right_knee"
  const char* plural;  // names both sides at once: "knees"; "" on the midline
  int first;           // index of its first angle
  std::span<const AngleInfo> angles;
};

// Angles of the midline and of either side, in the order of the joints below.
enum MidlineAngle : int {
  kSpineFlexion,
  kSpineBend,
  kSpineTurn,
  kNeckFlexion,
  kNeckBend,
  kNeckTurn,
  kMidlineAngleCount
};
enum SideAngle : int {
  kShoulderFlexion,
  kShoulderAbduction,
  kShoulderRotation,
  kElbowFlexion,
  kPronation,
  kWristFlexion,
  kUlnarDeviation,
  kHipFlexion,
  kHipAbduction,
  kHipRotation,
  kKneeFlexion,
  kDorsiflexion,
  kInversion,
  kSideAngleCount
};

std::span<const JointInfo> MidlineJoints();
std::span<const JointInfo> SideJoints();

// The swing of a shoulder (see above) ends where the arm points straight up.
inline constexpr double kMaxShoulderSwing_deg = 180.0;

}  // namespace vitruvia
