// The 17-bone skeleton of paper A and its poses.
//
// Paper A prints 17 bones and a tree (figure 5) without naming all of them; ours are below.
//
// Subject frame: y up, z to the subject's front, x to the subject's left, metres, floor at y = 0.
// Rest pose: a T-pose, arms along ±x, palms down, feet forward. Every bone's rest rotation is the
// identity, so a bone's rotation is its rotation relative to the rest pose.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "math/vector.h"

namespace vitruvia {

enum class BoneId : int {
  kPelvis,
  kAbdomen,
  kChest,
  kNeck,
  kHead,
  kLeftUpperArm,
  kLeftForearm,
  kLeftHand,
  kRightUpperArm,
  kRightForearm,
  kRightHand,
  kLeftThigh,
  kLeftShin,
  kLeftFoot,
  kRightThigh,
  kRightShin,
  kRightFoot,
};
inline constexpr int kBoneCount = 17;

struct BoneInfo {
  std::string_view name;   // of the bone
  std::string_view joint;  // of the joint at its proximal end, which connects it to the parent
  int parent;              // index, always smaller than the bone's own; -1 for the pelvis
  int mirror;              // the bone of the other side, itself on the midline
};
// In the order of BoneId.
const std::array<BoneInfo, kBoneCount>& Bones();
int FindBone(std::string_view bone_name);    // -1 if there is none
int FindJoint(std::string_view joint_name);  // -1 if there is none

// Joint positions in the rest pose: where bone j meets its parent, and each bone's far end.
struct Skeleton {
  std::array<Vector3<double>, kBoneCount> joints;  // proximal ends, subject frame, metres
  std::array<Vector3<double>, kBoneCount>
      tips;  // distal ends: crown, finger tips, toe tips at the leaves
};

// A pose in joint space: the rotation of each bone relative to its parent (the pelvis: relative to
// the subject frame), and the position of the pelvis joint. Independent of the body's proportions,
// except for that position.
struct JointPose {
  std::array<Matrix3<double>, kBoneCount> local_rotations;    // parent_from_bone
  Vector3<double> pelvis_position = Vector3<double>::Zero();  // subject frame, metres

  static JointPose Rest(const Skeleton& skeleton);
};

// A pose as skinning needs it: for each bone the rigid motion from the rest pose.
using BoneTransforms = std::vector<Rigidd>;  // posed_from_rest, size = number of bones

BoneTransforms ForwardKinematics(const Skeleton& skeleton, const JointPose& pose);

// The joints' posed positions (as many as transforms).
std::vector<Vector3<double>> PosedJoints(const Skeleton& skeleton, const BoneTransforms& bones);

// Joint names that only the sequence or only the skeleton has, in the order of their source.
struct UnmatchedJoints {
  std::vector<std::string> only_in_sequence, only_in_skeleton;
};
UnmatchedJoints FindUnmatchedJoints(const std::vector<std::string>& joints_of_sequence);

}  // namespace vitruvia
