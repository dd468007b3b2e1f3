// Motion files: key frames in JSON.
//
//   {
//     "title": "Raise the left arm and lower it, then the right one",
//     "loop": false,              repeat for ever; the last key frame is then the first again
//     "then_mirrored": true,      append the whole motion with left and right exchanged
//     "poses": [{"name": "stand", "angles": {"shoulders": {"abduction_deg": 8}}}],
//     "keyframes": [
//       {"time_s": 0, "pose": "stand"},
//       {"time_s": 1, "pose": "stand", "angles": {"left_shoulder": {"abduction_deg": 150}}},
//       {"time_s": 2, "pose": "stand"}]
//   }
//
// A key frame is a whole pose: the neutral position of joint_limits.h, over it the named pose, over
// that its own angles. Between key frames each angle follows a monotone cubic (keyframes_spline.h).
#pragma once

#include <filesystem>
#include <vector>

#include "config/settings.h"
#include "synth/motions/keyframes_pose.h"

namespace vitruvia {

// Limbs that may stand on the floor without slipping.
enum Support : int { kLeftFoot, kRightFoot, kLeftHand, kRightHand, kSupportCount };

// Position of the body and rotation of the pelvis. The rotation is heading · pitch · roll; in the
// rest pose all are zero.
struct RootState {
  double left_m = 0.0, forward_m = 0.0;  // of the path on the floor, from the start
  double heading_deg = 0.0;              // turns to the left
  double pitch_deg = 0.0;                // tips forward: 90 is prone, 180 upside down
  double roll_deg = 0.0;                 // tips to the left
  double clearance_m = 0.0;              // of the lowest point above the floor
};

struct KeyFrame {
  double time_s = 0.0;
  AnatomicalPose angles;
  RootState root;
  std::array<bool, kSupportCount> planted{};
};

struct KeyframeSequence {
  bool loop = false;
  std::vector<KeyFrame> keys;  // at least one; first at 0 s, times increasing
};

// ConfigError naming file, key frame, joint, angle and limit for any violation of this format, for
// times that do not increase, and for a loop that does not close.
KeyframeSequence ReadKeyframes(const std::filesystem::path& file);

// Walks over the fields of a motion file.
void VisitMotionFile(Fields& fields);

}  // namespace vitruvia
