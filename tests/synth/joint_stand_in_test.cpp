// The stand-in for a joint detector makes the noise that it states.
#include "synth/sensor/joint_stand_in.h"

#include <cmath>

#include <gtest/gtest.h>

namespace vitruvia {
namespace {

TEST(JointStandIn, AddsTheStatedDeviationAndBias) {
  const JointStandInSettings settings{
      .deviation_m = 0.02, .depth_bias_m = 0.05, .outlier_share = 0.0};
  const std::vector<Vector3d> truth(50, Vector3d(0.0, 0.0, 2.0));
  const std::vector<bool> known(truth.size(), true);
  double squares = 0.0, depth = 0.0;
  constexpr int kFrames = 100;
  for (int frame = 0; frame < kFrames; ++frame) {
    for (const Vector3d& joint : StandInJoints(settings, truth, known, frame)) {
      squares += joint.x() * joint.x();
      depth += joint.z();
    }
  }
  constexpr double kCount = 50.0 * kFrames;
  EXPECT_NEAR(std::sqrt(squares / kCount), 0.02, 0.001);
  EXPECT_NEAR(depth / kCount, 2.05, 0.001);
}

TEST(JointStandIn, PutsTheStatedShareAnywhereInACube) {
  const JointStandInSettings settings{
      .deviation_m = 0.0, .outlier_share = 0.2, .outlier_reach_m = 0.3};
  const std::vector<Vector3d> truth(2000, Vector3d(0.1, 0.2, 2.0));
  int moved = 0;
  for (const Vector3d& joint :
       StandInJoints(settings, truth, std::vector<bool>(truth.size(), true), 0)) {
    EXPECT_LE((joint - truth[0]).cwiseAbs().maxCoeff(), 0.3);
    moved += joint != truth[0] ? 1 : 0;
  }
  EXPECT_NEAR(moved / 2000.0, 0.2, 0.03);
}

TEST(JointStandIn, LeavesOutWhatIsNotKnown) {
  const std::vector<Vector3d> joints =
      StandInJoints({}, {Vector3d(0, 0, 2), Vector3d(0, 1, 2)}, {true, false}, 3);
  EXPECT_TRUE(joints[0].allFinite());
  EXPECT_FALSE(joints[1].allFinite());
}

}  // namespace
}  // namespace vitruvia
