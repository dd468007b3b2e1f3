#include "methods/dynamic/kinematic_tree.h"

#include <gtest/gtest.h>

#include "dynamic_fixtures.h"
#include "math/rigid.h"
#include "math/rotation.h"

namespace vitruvia::dynamic {
namespace {

Rigidd RigidOf(const DualQuaternion<double>& q) { return q.ToRigid(); }

void ExpectSame(const Rigidd& a, const Rigidd& b, double tolerance, const std::string& what) {
  EXPECT_LT((a.rotation - b.rotation).norm(), tolerance) << what;
  EXPECT_LT((a.translation - b.translation).norm(), tolerance) << what;
}

TEST(Joints, AreRotationsAboutAndTranslationsAlongTheirAxes) {
  const Vector3d axis = Vector3d(1.0, -2.0, 0.5).normalized();
  ExpectSame(RigidOf(HingeMotion(axis, 0.7)),
             {Eigen::AngleAxisd(0.7, axis).toRotationMatrix(), Vector3d::Zero()}, 1e-15, "eq. 1");
  ExpectSame(RigidOf(PrismaticMotion(axis, 0.3)), {Matrix3<double>::Identity(), 0.3 * axis}, 1e-15,
             "eq. 2");
}

TEST(Joints, ProductsOfDualQuaternionsAreProductsOfTransforms) {
  const Rigidd a{ExpSo3<double>({0.3, -1.0, 0.4}), {1.0, 2.0, 3.0}};
  const Rigidd b{ExpSo3<double>({-2.0, 0.1, 0.9}), {-0.5, 0.2, 0.7}};
  ExpectSame(
      RigidOf(Product(DualQuaternion<double>::FromRigid(a), DualQuaternion<double>::FromRigid(b))),
      a * b, 1e-14, "product");
}

TEST(KinematicTree, IsTheStartAtZero) {
  const KinematicTree tree(HumanSkeleton(), TinyBody().skeleton);
  TreePose pose;
  tree.Pose(CameraFromStart(), Eigen::VectorXd::Zero(tree.joint_count()), pose);
  for (const auto& bone : pose.camera_from_rest) {
    ExpectSame(RigidOf(bone), CameraFromStart(), 1e-14, "bind pose");
  }
}

// Hinges in a row are a local rotation of the body's own kinematics.
TEST(KinematicTree, AgreesWithTheBodysForwardKinematics) {
  const Skeleton skeleton = TinyBody().skeleton;
  const KinematicTree tree(HumanSkeleton(), skeleton);
  Eigen::VectorXd theta = RandomTheta(tree, 0.9, 3);
  JointPose expected = JointPose::Rest(skeleton);
  std::vector<char> is_of_ancestor(tree.joint_count());
  for (int bone = 0; bone < kBoneCount; ++bone) {
    std::fill(is_of_ancestor.begin(), is_of_ancestor.end(), 0);
    const int parent = Bones()[bone].parent;
    if (parent >= 0) {
      for (const int joint : tree.ChainOf(parent)) is_of_ancestor[joint] = 1;
    }
    Matrix3<double> local = Matrix3<double>::Identity();
    for (const int k : tree.ChainOf(bone)) {
      if (is_of_ancestor[k] != 0) continue;
      const TreeJoint& joint = tree.joints()[k];
      if (joint.type == JointType::kPrismatic) {
        theta[k] = 0.0;  // the body's own kinematics has no slides
      } else {
        local = local * Eigen::AngleAxisd(theta[k], joint.axis).toRotationMatrix();
      }
    }
    expected.local_rotations[bone] = local;
  }
  TreePose pose;
  tree.Pose(CameraFromStart(), theta, pose);
  const BoneTransforms bones = ForwardKinematics(skeleton, expected);
  for (int bone = 0; bone < kBoneCount; ++bone) {
    ExpectSame(RigidOf(pose.camera_from_rest[bone]), CameraFromStart() * bones[bone], 1e-13,
               std::string(Bones()[bone].name));
  }
}

TEST(KinematicTree, TwistsAreTheDerivativesOfTheBonesMotions) {
  const KinematicTree tree(HumanSkeleton(), TinyBody().skeleton);
  const Eigen::VectorXd theta = RandomTheta(tree, 0.8, 5);
  TreePose pose, ahead, behind;
  tree.Pose(CameraFromStart(), theta, pose);
  const double step = 1e-6;
  const Vector3d point(0.2, 1.1, 0.3);
  for (int bone = 0; bone < kBoneCount; ++bone) {
    const std::vector<int>& chain = tree.ChainOf(bone);
    for (int k = 0; k < tree.joint_count(); ++k) {
      const Eigen::VectorXd change = step * Eigen::VectorXd::Unit(tree.joint_count(), k);
      tree.Pose(CameraFromStart(), theta + change, ahead);
      tree.Pose(CameraFromStart(), theta - change, behind);
      const Vector3d numeric = (RigidOf(ahead.camera_from_rest[bone]) * point -
                                RigidOf(behind.camera_from_rest[bone]) * point) /
                               (2.0 * step);
      Vector3d expected = Vector3d::Zero();
      if (std::find(chain.begin(), chain.end(), k) != chain.end()) {
        const Vector3d posed = RigidOf(pose.camera_from_rest[bone]) * point;
        expected =
            pose.twists[k].head<3>().cross(posed - pose.twist_origin) + pose.twists[k].tail<3>();
      }
      EXPECT_LT((numeric - expected).norm(), 1e-8) << tree.joints()[k].name << " on " << bone;
    }
  }
}

TEST(KinematicTree, BonesWithoutAJointGoWithTheirParent) {
  const KinematicTree tree(
      ReadSkeletonFile(std::string(VITRUVIA_SOURCE_DIR) + "/configs/skeletons/human_waist_up.json"),
      TinyBody().skeleton);
  TreePose pose;
  tree.Pose(CameraFromStart(), RandomTheta(tree, 0.5, 7), pose);
  const Rigidd pelvis = RigidOf(pose.camera_from_rest[0]);
  for (const BoneId id : {BoneId::kLeftThigh, BoneId::kRightFoot}) {
    ExpectSame(RigidOf(pose.camera_from_rest[static_cast<int>(id)]), pelvis, 1e-14, "leg");
  }
}

TEST(KinematicTree, ClampsToTheLimits) {
  const KinematicTree tree(HumanSkeleton(), TinyBody().skeleton);
  Eigen::VectorXd theta = Eigen::VectorXd::Constant(tree.joint_count(), 1e6);
  tree.Clamp(theta);
  for (int k = 0; k < tree.joint_count(); ++k) EXPECT_EQ(theta[k], tree.joints()[k].upper);
}

}  // namespace
}  // namespace vitruvia::dynamic
