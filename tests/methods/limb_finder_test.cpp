// A limb is put where it is asked for, and found where the frame shows it.
#include "methods/realtime_scape/limb_finder.h"

#include <gtest/gtest.h>

#include "body/skinning.h"
#include "math/rotation.h"
#include "methods/posed_tiny_body.h"
#include "methods/realtime_scape/realtime_scape.h"
#include "support/arm_stage.h"

namespace vitruvia::realtime_scape {
namespace {

struct WithLimb : testing::Test, PosedTinyBody {
  Vector3d JointOf(const BodyPose& pose, int moved_by, BoneId joint) const {
    const int bone = static_cast<int>(joint);
    return pose[moved_by].center +
           pose[moved_by].rotation * (model.skeleton.joints[bone] - model.rest_centers[moved_by]);
  }
};

TEST_F(WithLimb, PutsItsEndAtTheTargetWithEveryJointWhole) {
  const BodyPose start = Articulated();
  for (const Limb& limb : Limbs()) {
    const int upper = static_cast<int>(limb.upper), lower = static_cast<int>(limb.lower);
    const int end = static_cast<int>(limb.end);
    const Vector3d root = JointOf(start, Bones()[upper].parent, limb.upper);
    const Vector3d target = root + Vector3d(0.1, -0.25, -0.2);
    for (const double swivel_rad : {0.0, 1.0, 4.0}) {
      const BodyPose moved = WithLimbAt(LimbBodyOf(model), start, limb, target, swivel_rad);
      EXPECT_LT((JointOf(moved, upper, limb.upper) - root).norm(), 1e-9);
      EXPECT_LT((JointOf(moved, upper, limb.lower) - JointOf(moved, lower, limb.lower)).norm(),
                1e-9);
      EXPECT_LT((JointOf(moved, lower, limb.end) - target).norm(), 1e-6);
      EXPECT_LT((JointOf(moved, end, limb.end) - target).norm(), 1e-6);
      // It bends about its hinge by a positive angle, and does not twist there.
      const Vector3d turn =
          LogSo3<double>(RelativeRotation(moved[upper].rotation, moved[lower].rotation));
      EXPECT_GT(turn.dot(limb.hinge), 0.1);
      EXPECT_LT(turn.cross(limb.hinge).norm(), 0.15 * turn.norm());
    }
  }
}

TEST_F(WithLimb, IsStretchedTowardsATargetOutOfReach) {
  const Limb& arm = Limbs()[0];
  const int upper = static_cast<int>(arm.upper), end = static_cast<int>(arm.end);
  const Vector3d root = JointOf(rest, Bones()[upper].parent, arm.upper);
  const Vector3d direction = Vector3d(0.2, 0.5, -0.8).normalized();
  const BodyPose moved = WithLimbAt(LimbBodyOf(model), rest, arm, root + 3.0 * direction, 0.0);
  const Vector3d reached = JointOf(moved, end, arm.end) - root;
  EXPECT_GT(reached.normalized().dot(direction), 1.0 - 1e-9);
  const auto& joints = model.skeleton.joints;
  const double length_m = (joints[static_cast<int>(arm.lower)] - joints[upper]).norm() +
                          (joints[end] - joints[static_cast<int>(arm.lower)]).norm();
  EXPECT_NEAR(reached.norm(), length_m, 0.002 * length_m);
}

// Both arms move by 70 degrees from one frame to the next.
double ErrorAfterALeap(double min_unexplained_m2) {
  ArmStage stage{1, SkinLinear, {Vector3d(1, -1, -1).asDiagonal(), {0.05, 0.9, 2.8}}};
  Settings settings;
  settings.limbs.min_unexplained_m2 = min_unexplained_m2;
  RealtimeScape tracker(settings);
  tracker.Start(stage.body, stage.camera);
  for (int i = 0; i < 3; ++i) tracker.TrackFrame(stage.Frame(i, 0.0));
  TrackResult last;
  for (int i = 3; i < 6; ++i) last = tracker.TrackFrame(stage.Frame(i, 1.2));
  return stage.MeanError(last, 1.2);
}

TEST(LimbFinder, FindsArmsThatMovedTooFarWithinOneFrame) {
  EXPECT_LT(ErrorAfterALeap(0.01), 0.01);
  EXPECT_GT(ErrorAfterALeap(0.0), 0.02);
}

}  // namespace
}  // namespace vitruvia::realtime_scape
