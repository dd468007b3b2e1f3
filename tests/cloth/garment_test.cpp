#include "synth/cloth/garment.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "cloth/simple_garment.h"
#include "math/rotation.h"
#include "support/tiny_body.h"

namespace vitruvia {
namespace {

JointPose BentElbow(const BodyModel& body, double angle_rad) {
  JointPose pose = JointPose::Rest(body.skeleton);
  pose.local_rotations[static_cast<int>(BoneId::kLeftForearm)] =
      ExpSo3<double>({0.0, -angle_rad, 0.0});
  return pose;
}

// How far each vertex was moved.
std::vector<double> Offsets(const BodyModel& body, const ClothSettings& settings,
                            const JointPose& pose, double time_s, std::uint64_t seed = 1) {
  std::vector<Vector3f> dressed;
  Garment(body, settings, seed).Dress(pose, time_s, dressed);
  std::vector<double> offsets;
  for (std::size_t v = 0; v < dressed.size(); ++v) {
    offsets.push_back((dressed[v] - body.rest.vertices[v]).norm());
  }
  return offsets;
}

double Largest(const std::vector<double>& offsets) {
  return *std::max_element(offsets.begin(), offsets.end());
}

TEST(Garment, LeavesABareBodyAsItIs) {
  const BodyModel body = TinyBody(2);
  EXPECT_TRUE(ClothSettings{}.IsBare());
  EXPECT_EQ(Largest(Offsets(body, {}, BentElbow(body, 1.0), 0.7)), 0.0);
}

TEST(Garment, LiesAsThickAsItIsOnTheTrunkAndNotOnTheHead) {
  const BodyModel body = TinyBody(2);
  ClothSettings settings;
  settings.thickness_m = 0.01;
  const auto offsets = Offsets(body, settings, JointPose::Rest(body.skeleton), 0.0);
  for (std::size_t v = 0; v < offsets.size(); ++v) {
    if (body.weights.weights[v][0] < 1.0f) continue;
    const auto bone = static_cast<BoneId>(body.weights.bones[v][0]);
    if (bone == BoneId::kChest || bone == BoneId::kLeftShin) {
      EXPECT_NEAR(offsets[v], 0.01, 1e-6);
    }
    if (bone == BoneId::kHead || bone == BoneId::kRightHand) {
      EXPECT_EQ(offsets[v], 0.0);
    }
  }
}

TEST(Garment, FoldsWhereAndWhenAJointBends) {
  const BodyModel body = TinyBody(4);
  ClothSettings settings;
  settings.fold_depth_m = 0.01;
  EXPECT_EQ(Largest(Offsets(body, settings, BentElbow(body, 0.0), 0.0)), 0.0);
  const auto little = Offsets(body, settings, BentElbow(body, 0.3), 0.0);
  const auto much = Offsets(body, settings, BentElbow(body, 1.5), 0.0);
  EXPECT_GT(Largest(little), 0.0002);
  EXPECT_GT(Largest(much), 2.0 * Largest(little));
  EXPECT_LT(Largest(much), 0.011);
  const Vector3d elbow = body.skeleton.joints[static_cast<int>(BoneId::kLeftForearm)];
  for (std::size_t v = 0; v < much.size(); ++v) {
    const double far = (body.rest.vertices[v].cast<double>() - elbow).norm();
    if (far > 0.45) {
      EXPECT_EQ(much[v], 0.0) << far;
    }
  }
}

TEST(Garment, WrinklesComeAndGoInTime) {
  const BodyModel body = TinyBody(2);
  ClothSettings settings;
  settings.wrinkle_depth_m = 0.005;
  const JointPose pose = JointPose::Rest(body.skeleton);
  const auto early = Offsets(body, settings, pose, 0.0), late = Offsets(body, settings, pose, 1.0);
  double change = 0.0;
  for (std::size_t v = 0; v < early.size(); ++v) {
    change = std::max(change, std::abs(early[v] - late[v]));
  }
  EXPECT_GT(change, 0.002);
}

TEST(Garment, HangsBelowALevelArmOnly) {
  const BodyModel body = TinyBody(2);
  ClothSettings settings;
  settings.drape_m = 0.02;
  std::vector<Vector3f> dressed;
  Garment(body, settings, 1).Dress(JointPose::Rest(body.skeleton), 0.0, dressed);
  const auto& rest = body.rest.vertices;
  double lowest = 0.0;
  for (std::size_t v = 0; v < rest.size(); ++v) {
    EXPECT_LE(dressed[v].y(), rest[v].y() + 1e-6f);
    lowest = std::max(lowest, double{rest[v].y() - dressed[v].y()});
    if (rest[v].y() < 0.9f) {
      EXPECT_LT((dressed[v] - rest[v]).norm(), 0.021f);
    }
  }
  EXPECT_GT(lowest, 0.005);
  EXPECT_LT(lowest, 0.021);
}

// Straight, bent, twisted and turned round joints.
TEST(Garment, EqualsThatComputedAnewForEachVertexAndFrame) {
  const BodyModel body = TinyBody(4);
  const ClothSettings settings{.volume_m = 0.008,
                               .thickness_m = 0.006,
                               .fold_depth_m = 0.008,
                               .wrinkle_depth_m = 0.003,
                               .drape_m = 0.01};
  const Garment garment(body, settings, 7);
  const SimpleGarment simple(body, settings, 7);
  std::vector<Vector3f> dressed, expected;
  for (int frame = 0; frame < 12; ++frame) {
    JointPose pose = BentElbow(body, 0.2 * frame);
    for (int bone = 0; bone < kBoneCount; bone += 1 + frame % 3) {
      pose.local_rotations[bone] =
          pose.local_rotations[bone] *
          ExpSo3<double>({0.1 * bone, 0.07 * frame, -0.05 * bone * (frame % 4)});
    }
    garment.Dress(pose, 0.3 * frame, dressed);
    simple.Dress(pose, 0.3 * frame, expected);
    EXPECT_EQ(dressed, expected) << frame;
  }
  EXPECT_NE(dressed, body.rest.vertices);
}

TEST(Garment, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const BodyModel body = TinyBody(2);
  ClothSettings settings;
  settings.volume_m = 0.01;
  const JointPose pose = JointPose::Rest(body.skeleton);
  EXPECT_EQ(Offsets(body, settings, pose, 0.0, 7), Offsets(body, settings, pose, 0.0, 7));
  EXPECT_NE(Offsets(body, settings, pose, 0.0, 7), Offsets(body, settings, pose, 0.0, 8));
}

}  // namespace
}  // namespace vitruvia
