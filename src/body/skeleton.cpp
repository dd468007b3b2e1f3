#include "body/skeleton.h"

#include <algorithm>

#include "core/error.h"
#include "math/rigid.h"

namespace vitruvia {
namespace {

constexpr int kNoParent = -1;

constexpr int Index(BoneId id) { return static_cast<int>(id); }

constexpr std::array<BoneInfo, kBoneCount> MakeBones() {
  using enum BoneId;
  std::array<BoneInfo, kBoneCount> bones{};
  const auto set = [&](BoneId id, std::string_view name, std::string_view joint, int parent,
                       BoneId mirror) {
    bones[Index(id)] = {name, joint, parent, Index(mirror)};
  };
  set(kPelvis, "pelvis", "pelvis", kNoParent, kPelvis);
  set(kAbdomen, "abdomen", "waist", Index(kPelvis), kAbdomen);
  set(kChest, "chest", "chest", Index(kAbdomen), kChest);
  set(kNeck, "neck", "neck", Index(kChest), kNeck);
  set(kHead, "head", "head", Index(kNeck), kHead);
  set(kLeftUpperArm, "left_upper_arm", "left_shoulder", Index(kChest), kRightUpperArm);
  set(kLeftForearm, "left_forearm", "left_elbow", Index(kLeftUpperArm), kRightForearm);
  set(kLeftHand, "left_hand", "left_wrist", Index(kLeftForearm), kRightHand);
  set(kRightUpperArm, "right_upper_arm", "right_shoulder", Index(kChest), kLeftUpperArm);
  set(kRightForearm, "right_forearm", "right_elbow", Index(kRightUpperArm), kLeftForearm);
  set(kRightHand, "right_hand", "right_wrist", Index(kRightForearm), kLeftHand);
  set(kLeftThigh, "left_thigh", "left_hip", Index(kPelvis), kRightThigh);
  set(kLeftShin, "left_shin", "left_knee", Index(kLeftThigh), kRightShin);
  set(kLeftFoot, "left_foot", "left_ankle", Index(kLeftShin), kRightFoot);
  set(kRightThigh, "right_thigh", "right_hip", Index(kPelvis), kLeftThigh);
  set(kRightShin, "right_shin", "right_knee", Index(kRightThigh), kLeftShin);
  set(kRightFoot, "right_foot", "right_ankle", Index(kRightShin), kLeftFoot);
  return bones;
}

constexpr std::array<BoneInfo, kBoneCount> kBones = MakeBones();

int FindBy(std::string_view BoneInfo::*name, std::string_view wanted) {
  const auto found = std::find_if(kBones.begin(), kBones.end(),
                                  [&](const BoneInfo& bone) { return bone.*name == wanted; });
  return found == kBones.end() ? -1 : static_cast<int>(found - kBones.begin());
}

}  // namespace

const std::array<BoneInfo, kBoneCount>& Bones() { return kBones; }

int FindBone(std::string_view bone_name) { return FindBy(&BoneInfo::name, bone_name); }
int FindJoint(std::string_view joint_name) { return FindBy(&BoneInfo::joint, joint_name); }

JointPose JointPose::Rest(const Skeleton& skeleton) {
  JointPose pose;
  pose.local_rotations.fill(Matrix3<double>::Identity());
  pose.pelvis_position = skeleton.joints[Index(BoneId::kPelvis)];
  return pose;
}

BoneTransforms ForwardKinematics(const Skeleton& skeleton, const JointPose& pose) {
  BoneTransforms posed_from_rest(kBoneCount);
  for (int bone = 0; bone < kBoneCount; ++bone) {
    const int parent = kBones[bone].parent;
    const Vector3<double>& rest_joint = skeleton.joints[bone];
    // Parents come first in the table. The joint moves as a point of the parent; the bone turns
    // about it.
    Rigidd& transform = posed_from_rest[bone];
    Vector3<double> posed_joint = pose.pelvis_position;
    transform.rotation = pose.local_rotations[bone];
    if (parent != kNoParent) {
      posed_joint = posed_from_rest[parent] * rest_joint;
      transform.rotation = posed_from_rest[parent].rotation * pose.local_rotations[bone];
    }
    transform.translation = posed_joint - transform.rotation * rest_joint;
  }
  return posed_from_rest;
}

std::vector<Vector3<double>> PosedJoints(const Skeleton& skeleton, const BoneTransforms& bones) {
  Require(bones.size() <= skeleton.joints.size(),
          "PosedJoints: {} transforms, but the skeleton has {} joints", bones.size(),
          skeleton.joints.size());
  std::vector<Vector3<double>> joints;
  joints.reserve(bones.size());
  for (std::size_t bone = 0; bone < bones.size(); ++bone) {
    joints.push_back(bones[bone] * skeleton.joints[bone]);
  }
  return joints;
}

UnmatchedJoints FindUnmatchedJoints(const std::vector<std::string>& joints_of_sequence) {
  UnmatchedJoints unmatched;
  for (const std::string& joint : joints_of_sequence) {
    if (FindJoint(joint) < 0) unmatched.only_in_sequence.push_back(joint);
  }
  for (const BoneInfo& bone : Bones()) {
    const bool there = std::find(joints_of_sequence.begin(), joints_of_sequence.end(),
                                 bone.joint) != joints_of_sequence.end();
    if (!there) unmatched.only_in_skeleton.emplace_back(bone.joint);
  }
  return unmatched;
}

}  // namespace vitruvia
