#include "fitting/angle_turns.h"

#include <algorithm>

#include "math/angles.h"

namespace vitruvia {
namespace {

using BonesOfAngles = std::array<std::vector<int>, kAngleCount>;

// Which bones each angle turns against their parents: those whose rotation changes with it.
BonesOfAngles FindBonesOfAngles() {
  constexpr double kAnywhere_deg = 7.0, kStep_deg = 5.0;
  constexpr double kLeastChange = 1e-6;
  const AngleVector angles = AngleVector::Constant(kAnywhere_deg);
  const JointPose pose = LocalRotations(angles);
  BonesOfAngles bones;
  for (int a = 0; a < kAngleCount; ++a) {
    AngleVector moved = angles;
    moved[a] += kStep_deg;
    const JointPose after = LocalRotations(moved);
    for (int b = 1; b < kBoneCount; ++b) {
      const double change = (after.local_rotations[b] - pose.local_rotations[b]).norm();
      if (change > kLeastChange) bones[a].push_back(b);
    }
  }
  return bones;
}

// Sets of angles no two of which turn the same bone: all of a set can be varied at once.
std::vector<std::vector<int>> FindIndependentSets(const BonesOfAngles& bones) {
  std::vector<std::vector<int>> sets;
  const auto share_a_bone = [&](int a, int b) {
    return std::any_of(bones[a].begin(), bones[a].end(), [&](int bone) {
      return std::find(bones[b].begin(), bones[b].end(), bone) != bones[b].end();
    });
  };
  for (int a = 0; a < kAngleCount; ++a) {
    const auto set = std::find_if(sets.begin(), sets.end(), [&](const std::vector<int>& others) {
      return std::none_of(others.begin(), others.end(),
                          [&](int other) { return share_a_bone(a, other); });
    });
    if (set == sets.end()) {
      sets.push_back({a});
    } else {
      set->push_back(a);
    }
  }
  return sets;
}

}  // namespace

JointPose LocalRotations(const AngleVector& angles_deg) {
  JointPose pose;
  pose.local_rotations.fill(Matrix3<double>::Identity());
  SetRotations(PoseOf(angles_deg), pose);
  return pose;
}

std::vector<AngleTurn> AngleTurns(const AngleVector& angles_deg) {
  constexpr double kStep_deg = 0.01;  // of central differences: exact to 1e-8
  constexpr double kLeastTurn = 1e-7;
  static const BonesOfAngles kBones = FindBonesOfAngles();
  static const std::vector<std::vector<int>> kSets = FindIndependentSets(kBones);
  std::vector<AngleTurn> turns;
  turns.reserve(kAngleCount + kBoneCount);
  for (const std::vector<int>& set : kSets) {
    AngleVector moved = angles_deg;
    for (const int a : set) moved[a] += kStep_deg;
    const JointPose after = LocalRotations(moved);
    for (const int a : set) moved[a] -= 2.0 * kStep_deg;
    const JointPose before = LocalRotations(moved);
    for (const int a : set) {
      for (const int b : kBones[a]) {
        const Matrix3<double> turn =
            after.local_rotations[b] * before.local_rotations[b].transpose();
        const Vector3d axis =
            Vector3d(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1)) /
            (4.0 * kStep_deg * kRadiansPerDegree);
        if (axis.norm() > kLeastTurn) turns.push_back({a, b, axis});
      }
    }
  }
  std::sort(turns.begin(), turns.end(), [](const AngleTurn& a, const AngleTurn& b) {
    return a.angle != b.angle ? a.angle < b.angle : a.bone < b.bone;
  });
  return turns;
}

}  // namespace vitruvia
