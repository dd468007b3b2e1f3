#include "body/start_poses.h"

#include <gtest/gtest.h>

namespace vitruvia {
namespace {

void ExpectWithin(std::span<const JointInfo> joints, std::span<const double> angles_deg,
                  const char* pose) {
  for (const JointInfo& joint : joints) {
    for (std::size_t a = 0; a < joint.angles.size(); ++a) {
      const double angle_deg = angles_deg[static_cast<std::size_t>(joint.first) + a];
      EXPECT_GE(angle_deg, joint.angles[a].min_deg) << pose << ", " << joint.name;
      EXPECT_LE(angle_deg, joint.angles[a].max_deg) << pose << ", " << joint.name;
    }
  }
}

TEST(StartPoses, AreWithinTheJointLimits) {
  for (const StartPose& start : StartPoses()) {
    ExpectWithin(MidlineJoints(), start.pose.midline_deg, start.name);
    for (const auto& side : start.pose.sides_deg) ExpectWithin(SideJoints(), side, start.name);
  }
}

TEST(StartPoses, LimbsAreWithinTheJointLimits) {
  for (const SideAngles& pose : ArmPoses()) ExpectWithin(SideJoints(), pose, "arm");
  for (const SideAngles& pose : LegPoses()) ExpectWithin(SideJoints(), pose, "leg");
}

TEST(StartPoses, TPoseIsTheRestPose) {
  JointPose pose;
  pose.local_rotations.fill(Matrix3<double>::Identity());
  SetRotations(StartPoses().front().pose, pose);
  for (const Matrix3<double>& rotation : pose.local_rotations) {
    EXPECT_LT((rotation - Matrix3<double>::Identity()).norm(), 1e-12);
  }
}

TEST(StartPoses, EveryOneHasItsMirrorImage) {
  for (const StartPose& start : StartPoses()) {
    const AnatomicalPose mirrored = Mirrored(start.pose);
    bool is_there = false;
    for (const StartPose& other : StartPoses()) {
      is_there |= other.pose.midline_deg == mirrored.midline_deg &&
                  other.pose.sides_deg == mirrored.sides_deg;
    }
    EXPECT_TRUE(is_there) << start.name;
  }
}

}  // namespace
}  // namespace vitruvia
