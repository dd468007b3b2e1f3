#include "methods/dynamic/placement.h"

#include <gtest/gtest.h>

#include "body/anatomical_pose.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "methods/dynamic/skeleton_file.h"
#include "support/tiny_body.h"

namespace vitruvia::dynamic {
namespace {

TEST(StartFrom, ReachesAPoseWithinItsJointLimits) {
  const BodyModel body = TinyBody();
  const KinematicTree tree(
      ReadSkeletonFile(std::string(VITRUVIA_SOURCE_DIR) + "/configs/skeletons/human.json"),
      body.skeleton);
  AnatomicalPose angles;
  angles.midline_deg[kSpineFlexion] = 10.0;
  angles.sides_deg[kLeft] = {30, 40, 0, 60, 0, 0, 0, 30, 5, 0, 40, 0, 0};
  angles.sides_deg[kRight] = {10, 60, 0, 30, 0, 0, 0, 5, 5, 0, 10, 0, 0};
  JointPose pose = JointPose::Rest(body.skeleton);
  SetRotations(angles, pose);
  pose.local_rotations[0] = ExpSo3<double>({0.1, 2.0, 0.0});
  pose.pelvis_position = {0.2, 0.1, 2.5};
  const BoneTransforms wanted = ForwardKinematics(body.skeleton, pose);

  const TreeStart start = StartFrom(tree, wanted);
  TreePose reached;
  tree.Pose(start.camera_from_start, start.theta, reached);
  constexpr double kWithin_rad = 0.03;  // the tree has no pronation that goes with the hand
  for (const BoneId bone :
       {BoneId::kPelvis, BoneId::kChest, BoneId::kHead, BoneId::kLeftUpperArm, BoneId::kLeftForearm,
        BoneId::kRightUpperArm, BoneId::kLeftThigh, BoneId::kLeftShin, BoneId::kRightFoot}) {
    const auto b = static_cast<std::size_t>(bone);
    const Matrix3<double> turn =
        wanted[b].rotation.transpose() * reached.camera_from_rest[b].ToRigid().rotation;
    EXPECT_LT(LogSo3<double>(turn).norm(), kWithin_rad) << Bones()[b].name;
  }
}

}  // namespace
}  // namespace vitruvia::dynamic
