#include "body/skeleton.h"

#include <numbers>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "core/random.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "tests/support/tiny_body.h"

namespace vitruvia {
namespace {

using Vec = Vector3<double>;
using Mat = Matrix3<double>;

constexpr double kExact = 1e-13;
constexpr double kQuarterTurn = std::numbers::pi / 2.0;

Mat RandomRotation(RandomStream& random) {
  const Vec axis = Vec(random.Normal(), random.Normal(), random.Normal()).normalized();
  return ExpSo3<double>(random.Uniform(0.0, 3.0) * axis);
}

JointPose RandomPose(const std::string& name) {
  RandomStream random(1, name);
  JointPose pose;
  for (Mat& rotation : pose.local_rotations) rotation = RandomRotation(random);
  pose.pelvis_position = {random.Normal(), random.Normal(), random.Normal()};
  return pose;
}

bool IsBelow(int bone, int ancestor) {
  while (bone != ancestor && bone >= 0) bone = Bones()[bone].parent;
  return bone == ancestor;
}

void ExpectEqual(const Rigidd& a, const Rigidd& b, int bone) {
  EXPECT_LT((a.rotation - b.rotation).cwiseAbs().maxCoeff(), kExact) << Bones()[bone].name;
  EXPECT_LT((a.translation - b.translation).cwiseAbs().maxCoeff(), kExact) << Bones()[bone].name;
}

// The same name with left and right exchanged.
std::string OtherSide(std::string name) {
  if (name.starts_with("left_")) return "right_" + name.substr(5);
  if (name.starts_with("right_")) return "left_" + name.substr(6);
  return name;
}

TEST(Bones, FormATreeInOrder) {
  EXPECT_EQ(Bones()[0].parent, -1);
  for (int b = 1; b < kBoneCount; ++b) {
    EXPECT_GE(Bones()[b].parent, 0);
    EXPECT_LT(Bones()[b].parent, b) << Bones()[b].name;
  }
}

TEST(Bones, AreFoundByTheirNamesAndJoints) {
  std::set<std::string_view> names, joints;
  for (int b = 0; b < kBoneCount; ++b) {
    EXPECT_EQ(FindBone(Bones()[b].name), b);
    EXPECT_EQ(FindJoint(Bones()[b].joint), b);
    names.insert(Bones()[b].name);
    joints.insert(Bones()[b].joint);
  }
  EXPECT_EQ(names.size(), kBoneCount);
  EXPECT_EQ(joints.size(), kBoneCount);
  EXPECT_EQ(FindBone("tail"), -1);
  EXPECT_EQ(FindJoint(""), -1);
  EXPECT_EQ(FindBone("left_forearm"), static_cast<int>(BoneId::kLeftForearm));
  EXPECT_EQ(FindJoint("left_elbow"), static_cast<int>(BoneId::kLeftForearm));
  EXPECT_EQ(FindJoint("waist"), static_cast<int>(BoneId::kAbdomen));
}

TEST(Bones, MirrorNamesParentsAndThemselves) {
  for (int b = 0; b < kBoneCount; ++b) {
    const BoneInfo &bone = Bones()[b], &other = Bones()[bone.mirror];
    EXPECT_EQ(other.mirror, b);
    EXPECT_EQ(other.name, OtherSide(std::string(bone.name)));
    EXPECT_EQ(other.joint, OtherSide(std::string(bone.joint)));
    EXPECT_EQ(other.parent, bone.parent < 0 ? -1 : Bones()[bone.parent].mirror);
  }
}

class Kinematics : public testing::Test {
 protected:
  Skeleton skeleton_ = TinyBody().skeleton;
};

TEST_F(Kinematics, RestPoseMovesNothing) {
  const BoneTransforms bones = ForwardKinematics(skeleton_, JointPose::Rest(skeleton_));
  ASSERT_EQ(bones.size(), kBoneCount);
  for (int b = 0; b < kBoneCount; ++b) {
    EXPECT_EQ(bones[b].rotation, Mat::Identity());
    EXPECT_EQ(bones[b].translation, Vec::Zero());
    EXPECT_EQ(PosedJoints(skeleton_, bones)[b], skeleton_.joints[b]);
  }
}

TEST_F(Kinematics, BonesStayJoined) {
  const BoneTransforms bones = ForwardKinematics(skeleton_, RandomPose("joined"));
  for (int b = 1; b < kBoneCount; ++b) {
    const Vec& joint = skeleton_.joints[b];
    EXPECT_LT((bones[b] * joint - bones[Bones()[b].parent] * joint).norm(), kExact);
  }
}

TEST_F(Kinematics, PelvisJointIsWhereThePoseSays) {
  const JointPose pose = RandomPose("pelvis");
  const auto joints = PosedJoints(skeleton_, ForwardKinematics(skeleton_, pose));
  EXPECT_LT((joints[0] - pose.pelvis_position).norm(), kExact);
}

TEST_F(Kinematics, LocalRotationsComeBack) {
  const JointPose pose = RandomPose("local");
  const BoneTransforms bones = ForwardKinematics(skeleton_, pose);
  for (int b = 0; b < kBoneCount; ++b) {
    const int parent = Bones()[b].parent;
    const Mat local = parent < 0 ? bones[b].rotation
                                 : Mat(bones[parent].rotation.transpose() * bones[b].rotation);
    EXPECT_LT((local - pose.local_rotations[b]).cwiseAbs().maxCoeff(), kExact);
  }
}

TEST_F(Kinematics, BonesKeepTheirLengths) {
  const auto joints = PosedJoints(skeleton_, ForwardKinematics(skeleton_, RandomPose("lengths")));
  for (int b = 1; b < kBoneCount; ++b) {
    const int parent = Bones()[b].parent;
    EXPECT_NEAR((joints[b] - joints[parent]).norm(),
                (skeleton_.joints[b] - skeleton_.joints[parent]).norm(), kExact);
  }
}

TEST_F(Kinematics, MotionOfTheRootMovesEverythingRigidly) {
  RandomStream random(2, "rigid");
  const Rigidd moved_from_before{RandomRotation(random), {0.5, -1.0, 2.0}};
  const JointPose before = RandomPose("root");
  JointPose after = before;
  after.local_rotations[0] = moved_from_before.rotation * before.local_rotations[0];
  after.pelvis_position = moved_from_before * before.pelvis_position;
  const BoneTransforms a = ForwardKinematics(skeleton_, before);
  const BoneTransforms b = ForwardKinematics(skeleton_, after);
  for (int bone = 0; bone < kBoneCount; ++bone) {
    ExpectEqual(b[bone], moved_from_before * a[bone], bone);
  }
}

TEST_F(Kinematics, ARotationMovesOnlyWhatHangsOnIt) {
  RandomStream random(3, "subtree");
  const JointPose before = RandomPose("subtree");
  const BoneTransforms a = ForwardKinematics(skeleton_, before);
  const auto joints = PosedJoints(skeleton_, a);
  for (int turned = 0; turned < kBoneCount; ++turned) {
    JointPose after = before;
    after.local_rotations[turned] *= RandomRotation(random);
    const BoneTransforms b = ForwardKinematics(skeleton_, after);
    EXPECT_LT((PosedJoints(skeleton_, b)[turned] - joints[turned]).norm(), kExact)
        << "a bone's own joint stays";
    // All that hangs on the bone turns about its joint as one.
    const Rigidd motion =
        RotationAbout<double>(b[turned].rotation * a[turned].rotation.transpose(), joints[turned]);
    for (int bone = 0; bone < kBoneCount; ++bone) {
      ExpectEqual(b[bone], IsBelow(bone, turned) ? motion * a[bone] : a[bone], bone);
    }
  }
}

TEST_F(Kinematics, MirroredPosesGiveMirroredBodies) {
  const Mat flip = Vec(-1.0, 1.0, 1.0).asDiagonal();
  const JointPose pose = RandomPose("mirror");
  JointPose mirrored;
  mirrored.pelvis_position = flip * pose.pelvis_position;
  for (int b = 0; b < kBoneCount; ++b) {
    mirrored.local_rotations[Bones()[b].mirror] = flip * pose.local_rotations[b] * flip;
  }
  const auto joints = PosedJoints(skeleton_, ForwardKinematics(skeleton_, pose));
  const auto others = PosedJoints(skeleton_, ForwardKinematics(skeleton_, mirrored));
  for (int b = 0; b < kBoneCount; ++b) {
    EXPECT_LT((others[Bones()[b].mirror] - flip * joints[b]).norm(), kExact);
  }
}

TEST_F(Kinematics, AnElbowBendsTheHandToTheFront) {
  // Left arm along +x; turning about −y takes +x to +z, the subject's front.
  JointPose pose = JointPose::Rest(skeleton_);
  pose.local_rotations[FindBone("left_forearm")] = ExpSo3<double>(Vec(0.0, -kQuarterTurn, 0.0));
  const auto joints = PosedJoints(skeleton_, ForwardKinematics(skeleton_, pose));
  const int elbow = FindJoint("left_elbow"), wrist = FindJoint("left_wrist");
  const double length = (skeleton_.joints[wrist] - skeleton_.joints[elbow]).norm();
  EXPECT_LT((joints[wrist] - (skeleton_.joints[elbow] + Vec(0.0, 0.0, length))).norm(), kExact);
}

TEST_F(Kinematics, PosedJointsRefusesTooManyTransforms) {
  EXPECT_THROW(PosedJoints(skeleton_, BoneTransforms(kBoneCount + 1)), std::invalid_argument);
  EXPECT_EQ(PosedJoints(skeleton_, BoneTransforms(3)).size(), 3u);
}

}  // namespace
}  // namespace vitruvia
