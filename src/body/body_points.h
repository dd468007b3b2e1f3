// The points of a body that a joint detector finds: its joints, and the tips of its leaf bones.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "body/skeleton.h"

namespace vitruvia {

inline constexpr int kBodyPointCount = kBoneCount + 5;

struct BodyPointInfo {
  std::string name;  // the joint's name; for a tip "head_tip", "left_hand_tip", …
  int bone;          // the bone that the point belongs to: the joint's bone, or the bone of the tip
  bool is_tip;       // the bone's distal end; otherwise its proximal one
  int parent;  // the previous point on the chain from the pelvis, always of smaller index; −1 for
               // the pelvis
};
// The joints in the order of BoneId, then the tips.
const std::array<BodyPointInfo, kBodyPointCount>& BodyPoints();
int FindBodyPoint(std::string_view name);  // −1 if there is none

using BodyPointPositions = std::array<Vector3<double>, kBodyPointCount>;  // metres

// By how much a skeleton is larger than one whose head's tip is 1.6 m above its ankles.
double SizeOf(const Skeleton& skeleton);

BodyPointPositions RestPoints(const Skeleton& skeleton);  // subject frame
BodyPointPositions PosedPoints(const Skeleton& skeleton, const BoneTransforms& posed_from_rest);

}  // namespace vitruvia
