#include "synth/motions/motion.h"

#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "math/rotation.h"
#include "motion_files.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;

const fs::path kMotions = fs::path(VITRUVIA_SOURCE_DIR) / "configs" / "motions";

MotionSettings SettingsOf(const std::string& name) {
  MotionSettings settings;
  settings.file = kMotions / (name + ".json");
  return settings;
}

std::unique_ptr<Motion> Shipped(const std::string& name) {
  MotionSettings settings = SettingsOf(name);
  settings.rest_s = settings.blend_s = 0.0;
  return LoadMotion(settings, TestSkeleton());
}

void ExpectSamePose(const JointPose& a, const JointPose& b, double tolerance = 0.0) {
  for (std::size_t i = 0; i < kBoneCount; ++i) {
    EXPECT_LE((a.local_rotations[i] - b.local_rotations[i]).norm(), tolerance) << Bones()[i].name;
  }
  EXPECT_LE((a.pelvis_position - b.pelvis_position).norm(), tolerance);
}

TEST(LeadIn, BeginsAtRestAndEndsInTheFirstPose) {
  const auto motion = LoadMotion(SettingsOf("boxing"), TestSkeleton());
  const auto bare = Shipped("boxing");
  const JointPose rest = JointPose::Rest(TestSkeleton());
  EXPECT_DOUBLE_EQ(motion->duration_s(), 1.2 + bare->duration_s());
  for (const double time : {-1.0, 0.0, 0.3, 0.5}) {
    const MotionSample sample = motion->At(time);
    ExpectSamePose(sample.pose, rest);
    EXPECT_EQ(sample.clearance_m, 0.0);
    EXPECT_TRUE(sample.grounded);
  }
  ExpectSamePose(motion->At(1.2).pose, bare->At(0.0).pose);
  ExpectSamePose(motion->At(1.2 - 1e-9).pose, bare->At(0.0).pose, 1e-12);
  ExpectSamePose(motion->At(1.9).pose, bare->At(0.7).pose, 1e-12);
}

TEST(LeadIn, TurnsJointsTheShortWayAndSteadily) {
  const auto motion = LoadMotion(SettingsOf("crouch"), TestSkeleton());
  const BoneId arm = BoneId::kLeftUpperArm;
  const auto at = [&](double time) {
    return motion->At(time).pose.local_rotations[static_cast<std::size_t>(arm)];
  };
  const double whole = LogSo3<double>(at(1.2)).norm();
  double last = 0.0;
  for (double time = 0.55; time <= 1.2; time += 0.05) {
    const double from_rest = LogSo3<double>(at(time)).norm();
    EXPECT_GT(from_rest, last);
    EXPECT_NEAR(from_rest + LogSo3<double>(Matrix3<double>(at(time).transpose() * at(1.2))).norm(),
                whole, 1e-9);
    last = from_rest;
  }
  EXPECT_NEAR(LogSo3<double>(at(0.85)).norm(), 0.5 * whole, 1e-9);
}

TEST(MotionSettings, PlaceTurnAndPaceTheMotion) {
  MotionSettings settings = SettingsOf("calisthenics");
  settings.rest_s = settings.blend_s = 0.0;
  const auto plain = LoadMotion(settings, TestSkeleton());
  settings.start_s = 6.2;  // one step to the left of the start
  settings.speed = 0.5;
  settings.heading_deg = 90.0;
  const auto turned = LoadMotion(settings, TestSkeleton());
  EXPECT_DOUBLE_EQ(turned->duration_s(), (plain->duration_s() - 6.2) / 0.5);
  EXPECT_NEAR((turned->At(0.0).pose.pelvis_position - TestSkeleton().joints[0]).norm(), 0.0, 1e-12);
  // Facing left instead of the front: what was to the left is to the back.
  const auto way = [](const Motion& motion, double from, double to) {
    return Vector3<double>(motion.At(to).pose.pelvis_position -
                           motion.At(from).pose.pelvis_position);
  };
  const Vector3<double> before = way(*plain, 6.2, 8.2), after = way(*turned, 0.0, 4.0);
  EXPECT_LT(before.x(), -0.1);
  EXPECT_NEAR(after.z(), -before.x(), 1e-9);
  EXPECT_NEAR(after.x(), before.z(), 1e-9);
  const Vector3<double> facing = turned->At(0.0).pose.local_rotations[0] * Vector3<double>::UnitZ();
  EXPECT_GT(facing.x(), 0.99);
}

TEST(MotionSettings, RefuseAFileThatIsNotThereAndAStartBeyondTheEnd) {
  MotionSettings settings = SettingsOf("no_such_motion");
  EXPECT_THROW(LoadMotion(settings, TestSkeleton()), ConfigError);
  settings = SettingsOf("crouch");
  settings.start_s = 100.0;
  try {
    LoadMotion(settings, TestSkeleton());
    FAIL() << "start_s was taken";
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("crouch.json: start_s: expected at most the motion's 4.2 s, got 100 s"),
              std::string::npos)
        << error.what();
  }
}

double FastestHand(const Motion& motion) {
  constexpr double kStep_s = 1.0 / 60.0;
  double fastest = 0.0;
  for (double time = 0.0; time + kStep_s <= motion.duration_s(); time += kStep_s) {
    const PosedBones before(motion, time), after(motion, time + kStep_s);
    for (const BoneId hand : {BoneId::kLeftHand, BoneId::kRightHand}) {
      fastest = std::max(fastest, (after.Tip(hand) - before.Tip(hand)).norm() / kStep_s);
    }
  }
  return fastest;
}

// Finger tips, metres per second, with the pelvis at constant height.
TEST(ShippedMotions, LoadWithinTheLimitsAndMoveAtTheirPace) {
  const std::map<std::string, double> bounds{{"arm_wave", 3.0},
                                             {"boxing", 6.0},
                                             {"calisthenics", 2.0},
                                             {"crouch", 1.5},
                                             {"elsewhere", 3.0},
                                             {"handstand", 4.0},
                                             {"handstand_scissors", 4.0},
                                             {"hands_on_body", 3.0},
                                             {"jumping_jack", 4.5},
                                             {"kick", 3.0},
                                             {"sit_down", 2.0},
                                             {"sit_on_chair", 2.0},
                                             {"t_pose", 0.3},
                                             {"towards_camera", 3.0},
                                             {"turn_360", 2.0},
                                             {"walk", 2.5}};
  // A twist about the arm's own axis moves no finger tip, and half a turn between two frames is
  // faster than anybody.
  const std::set<std::string> hard_cases{"arm_twist", "half_turn"};
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kMotions)) {
    const std::string name = entry.path().stem().string();
    EXPECT_NE(Shipped(name), nullptr);
    if (!hard_cases.contains(name)) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  ASSERT_EQ(names.size(), bounds.size());
  for (const std::string& name : names) {
    ASSERT_TRUE(bounds.contains(name)) << name;
    const double fastest = FastestHand(*Shipped(name));
    EXPECT_LT(fastest, bounds.at(name)) << name;
    EXPECT_GT(fastest, 0.05) << name;
  }
}

TEST(ShippedMotions, CalisthenicsBeginsAndEndsInTheTPoseAtOnePlace) {
  const auto motion = Shipped("calisthenics");
  EXPECT_GE(motion->duration_s(), 10.0);
  EXPECT_LE(motion->duration_s(), 12.0);
  for (const double time : {0.0, motion->duration_s()}) {
    const PosedBones bones(*motion, time);
    for (std::size_t i = 0; i < kBoneCount; ++i) {
      EXPECT_LT((bones.tips[i] - TestSkeleton().tips[i]).norm(), 0.03) << Bones()[i].name;
    }
  }
}

TEST(ShippedMotions, WalkingSwingsEachArmAgainstItsLeg) {
  const auto motion = Shipped("walk");
  double together = 0.0;
  for (double time = 0.0; time < motion->duration_s(); time += 0.02) {
    const PosedBones bones(*motion, time);
    const double arms = bones.Tip(BoneId::kLeftHand).z() - bones.Tip(BoneId::kRightHand).z();
    const double legs = bones.Joint(BoneId::kLeftFoot).z() - bones.Joint(BoneId::kRightFoot).z();
    together += arms * legs;
  }
  EXPECT_LT(together, -1.0);
}

// Heights above the lowest joint or far end of a bone.
double HeightAt(const PosedBones& bones, const Vector3<double>& point) {
  double lowest = point.y();
  for (std::size_t i = 0; i < kBoneCount; ++i) {
    lowest = std::min({lowest, bones.joints[i].y(), bones.tips[i].y()});
  }
  return point.y() - lowest;
}

TEST(ShippedMotions, TheHandstandIsUpsideDownOnTheHands) {
  const auto motion = Shipped("handstand");
  const PosedBones bones(*motion, 5.1);
  EXPECT_LT(HeightAt(bones, bones.Tip(BoneId::kLeftHand)), 0.02);
  EXPECT_LT(HeightAt(bones, bones.Tip(BoneId::kRightHand)), 0.02);
  EXPECT_LT(bones.Tip(BoneId::kHead).y(), bones.Joint(BoneId::kChest).y());
  EXPECT_LT(bones.Joint(BoneId::kChest).y(), bones.Joint(BoneId::kPelvis).y());
  EXPECT_LT(bones.Joint(BoneId::kPelvis).y(), bones.Joint(BoneId::kLeftFoot).y() - 0.7);
}

TEST(ShippedMotions, SittingDownBringsThePelvisToTheFloor) {
  const auto motion = Shipped("sit_down");
  const PosedBones standing(*motion, 0.0), seated(*motion, 4.0);
  EXPECT_GT(HeightAt(standing, standing.Joint(BoneId::kLeftThigh)), 0.8);
  EXPECT_LT(HeightAt(seated, seated.Joint(BoneId::kLeftThigh)), 0.2);
  EXPECT_GT(seated.Tip(BoneId::kHead).y(), seated.Joint(BoneId::kPelvis).y() + 0.6);
}

TEST(ShippedMotions, TheTurnGoesAllTheWayRound) {
  const auto motion = Shipped("turn_360");
  double turned = 0.0;
  Matrix3<double> before = motion->At(0.0).pose.local_rotations[0];
  for (int i = 1; i <= 60; ++i) {
    const Matrix3<double> now = motion->At(motion->duration_s() * i / 60.0).pose.local_rotations[0];
    turned += LogSo3<double>(Matrix3<double>(before.transpose() * now)).y();
    before = now;
  }
  EXPECT_NEAR(turned, 6.283185307, 1e-6);
}

}  // namespace
}  // namespace vitruvia
