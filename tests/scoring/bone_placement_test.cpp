#include "scoring/bone_placement.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "math/rigid.h"
#include "math/rotation.h"
#include "support/tiny_body.h"

namespace vitruvia {
namespace {

// A figure of boxes in a pose; vertices between two bones follow both by half.
class PosedFigure : public testing::Test {
 protected:
  PosedFigure() {
    JointPose pose = JointPose::Rest(body_.skeleton);
    const auto turn = [&](BoneId bone, const Vector3d& by) {
      pose.local_rotations[static_cast<std::size_t>(bone)] = ExpSo3<double>(by);
    };
    turn(BoneId::kPelvis, {0.1, 0.4, 0.0});
    turn(BoneId::kAbdomen, {0.2, 0.0, 0.1});
    turn(BoneId::kLeftForearm, {0.0, 0.3, 0.8});
    bones_ = ForwardKinematics(body_.skeleton, pose);
    SkinLinear(body_.rest.vertices, body_.weights, bones_, posed_);
  }

  BodyModel body_ = TinyBody(3);
  BoneTransforms bones_;
  std::vector<Vector3f> posed_;
};

TEST_F(PosedFigure, BonesAreFoundFromTheSurface) {
  const BoneTransforms found = BonePlacement(body_.rest.vertices, body_).Fit(posed_);
  for (int bone = 0; bone < kBoneCount; ++bone) {
    const Vector3d joint = body_.skeleton.joints[bone];
    EXPECT_LT((found[bone] * joint - bones_[bone] * joint).norm(), 1e-4) << Bones()[bone].name;
    EXPECT_LT((found[bone].rotation - bones_[bone].rotation).norm(), 1e-3) << Bones()[bone].name;
  }
}

TEST_F(PosedFigure, WarpIsWhatBonesDoNotExplain) {
  const BonePlacement placement(body_.rest.vertices, body_);
  EXPECT_LT(std::ranges::max(placement.Warps(posed_)), 1e-4f);
  const std::size_t warped = 7;  // one of many vertices of its bone
  posed_[warped] += Vector3f(0.0f, 0.0f, 0.05f);
  EXPECT_NEAR(placement.Warps(posed_)[warped], 0.05f, 0.005f);
}

}  // namespace
}  // namespace vitruvia
