// A body that is tracked back to front is told from one that is not.
#include "methods/realtime_scape/facing.h"

#include <gtest/gtest.h>

#include "body/skinning.h"
#include "math/rotation.h"
#include "methods/posed_tiny_body.h"
#include "methods/realtime_scape/realtime_scape.h"
#include "support/arm_stage.h"

namespace vitruvia::realtime_scape {
namespace {

struct Facing : testing::Test, PosedTinyBody {
  Vector3d JointOf(const BodyPose& pose, int bone) const {
    return pose[bone].center +
           pose[bone].rotation * (model.skeleton.joints[bone] - model.rest_centers[bone]);
  }
};

TEST_F(Facing, ExchangesSidesAndFrontWithEveryJointWhereItsMirrorImageWas) {
  const auto other_facing = [&](const BodyPose& pose) {
    return ToPose(model, FacingAway(model.skeleton, ToTransforms(model, pose)));
  };
  const BodyPose pose = Articulated(), away = other_facing(pose);
  for (int bone = 0; bone < kBoneCount; ++bone) {
    const int mirror = Bones()[bone].mirror;
    EXPECT_LT((JointOf(away, bone) - JointOf(pose, mirror)).norm(), 1e-9);
    const Vector3d front = away[bone].rotation.col(2), up = away[bone].rotation.col(1);
    EXPECT_LT((front + pose[mirror].rotation.col(2)).norm(), 1e-9);
    EXPECT_LT((up - pose[mirror].rotation.col(1)).norm(), 1e-9);
  }
  const BodyPose back = other_facing(away);
  for (int bone = 0; bone < kBoneCount; ++bone) {
    EXPECT_LT((back[bone].rotation - pose[bone].rotation).norm(), 1e-9);
    EXPECT_LT((back[bone].center - pose[bone].center).norm(), 1e-9);
  }
}

// The body turns by 180 degrees about its own vertical from one frame to the next.
double ErrorAfterAHalfTurn(double margin_m) {
  const Rigidd before{Vector3d(1, -1, -1).asDiagonal(), {0.05, 0.9, 2.8}};
  const Rigidd turned =
      before * Rigidd{Vector3d(-1, 1, -1).asDiagonal().toDenseMatrix(), Vector3d::Zero()};
  ArmStage first{1, SkinLinear, before}, second{1, SkinLinear, turned};
  Settings settings;
  settings.facing.margin_m = margin_m;
  RealtimeScape tracker(settings);
  tracker.Start(first.body, first.camera);
  for (int i = 0; i < 5; ++i) tracker.TrackFrame(first.Frame(i, 0.05 * i));
  TrackResult last;
  for (int i = 5; i < 9; ++i) last = tracker.TrackFrame(second.Frame(i, 0.2));
  return second.MeanError(last, 0.2);
}

TEST(FacingCheck, FollowsAHalfTurnFromOneFrameToTheNext) {
  EXPECT_GT(ErrorAfterAHalfTurn(0.0), 0.05);
  EXPECT_LT(ErrorAfterAHalfTurn(FacingSettings{}.margin_m), 0.02);
}

}  // namespace
}  // namespace vitruvia::realtime_scape
