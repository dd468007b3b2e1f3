// The skeleton-driven baseline: its inverse kinematics against differences and known poses, and an
// easy scene.
#include "methods/skeleton_driven/skeleton_driven.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/random.h"
#include "math/rotation.h"
#include "support/tiny_body.h"

namespace vitruvia::skeleton_driven {
namespace {

// Every bone turned a little, the whole body before a camera.
BoneTransforms SomePose(const Skeleton& skeleton) {
  RandomStream random(5, "pose");
  JointPose pose = JointPose::Rest(skeleton);
  for (Matrix3<double>& rotation : pose.local_rotations) {
    rotation = ExpSo3<double>(
        Vector3d::NullaryExpr([&](Eigen::Index) { return random.Normal(0.0, 0.25); }));
  }
  BoneTransforms bones = ForwardKinematics(skeleton, pose);
  const Rigidd camera_from_subject{Vector3d(1, -1, -1).asDiagonal(), {0.1, 0.9, 2.5}};
  for (Rigidd& bone : bones) bone = camera_from_subject * bone;
  return bones;
}

GivenPoints PointsOf(const Skeleton& skeleton, const BoneTransforms& bones) {
  GivenPoints points;
  const BodyPointPositions positions = PosedPoints(skeleton, bones);
  std::copy(positions.begin(), positions.end(), points.begin());
  return points;
}

SkeletonPose ToPose(const Skeleton& skeleton, const BoneTransforms& bones) {
  SkeletonPose pose;
  pose.pelvis_position = bones[0] * skeleton.joints[0];
  for (int b = 0; b < kBoneCount; ++b) pose.rotations[b] = bones[b].rotation;
  return pose;
}

double MeanDistance(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).norm();
  return sum / static_cast<double>(a.size());
}

class InverseKinematicsOfABody : public ::testing::Test {
 protected:
  const Skeleton skeleton = TinyBody().skeleton;
  const BoneTransforms bones = SomePose(skeleton);
};

TEST_F(InverseKinematicsOfABody, RowsAreTheDerivativesOfTheResiduals) {
  const InverseKinematics solver(skeleton, {});
  GivenPoints points = PointsOf(skeleton, SomePose(skeleton));
  for (auto& point : points) *point += Vector3d(0.02, -0.03, 0.01);
  points[3].reset();
  const SkeletonPose pose = ToPose(skeleton, bones);
  const InverseKinematicsRows rows = solver.Rows(pose, points);
  constexpr double kStep = 1e-5;
  for (int k = 0; k < InverseKinematicsRows::kParameters; ++k) {
    Eigen::VectorXd step = Eigen::VectorXd::Zero(InverseKinematicsRows::kParameters);
    step[k] = kStep;
    const auto ahead = solver.Rows(solver.Stepped(pose, step), points).residuals;
    const auto behind = solver.Rows(solver.Stepped(pose, -step), points).residuals;
    const Eigen::VectorXd difference = (ahead - behind) / (2.0 * kStep);
    EXPECT_LT((difference - rows.rows.col(k)).norm(), 1e-5 * (1.0 + difference.norm())) << k;
  }
}

TEST_F(InverseKinematicsOfABody, PointsAtTheTruthPullAtNothing) {
  const InverseKinematics solver(skeleton, {});
  const InverseKinematicsRows rows =
      solver.Rows(ToPose(skeleton, bones), PointsOf(skeleton, bones));
  EXPECT_LT(rows.residuals.head<InverseKinematicsRows::kPointRows>().norm(), 1e-9);
}

TEST_F(InverseKinematicsOfABody, FindsTheJointsOfAPoseFromTheirPositions) {
  InverseKinematicsSettings settings;
  settings.pose_weight = 1e-6;
  settings.iterations = 50;
  settings.stop_rad = 1e-6;
  const auto found = InverseKinematics(skeleton, settings).Find(PointsOf(skeleton, bones));
  ASSERT_TRUE(found);
  EXPECT_LT(found->median_m, 1e-4);
}

TEST_F(InverseKinematicsOfABody, KeepsTheLengthsOfTheBones) {
  GivenPoints points = PointsOf(skeleton, bones);
  for (auto& point : points) *point *= 1.2;  // a larger person
  const auto found = InverseKinematics(skeleton, {}).Find(points);
  ASSERT_TRUE(found);
  const std::vector<Vector3d> joints = PosedJoints(skeleton, ToTransforms(skeleton, found->pose));
  for (int b = 1; b < kBoneCount; ++b) {
    const int parent = Bones()[b].parent;
    EXPECT_NEAR((joints[b] - joints[parent]).norm(),
                (skeleton.joints[b] - skeleton.joints[parent]).norm(), 1e-9);
  }
}

TEST_F(InverseKinematicsOfABody, MovesRigidlyWithThePoints) {
  InverseKinematicsSettings settings;
  settings.iterations = 200;
  settings.stop_rad = 1e-10;
  const InverseKinematics solver(skeleton, settings);
  const GivenPoints points = PointsOf(skeleton, bones);
  const Rigidd motion{ExpSo3<double>({0.3, -0.8, 0.2}), {0.2, -0.1, 0.4}};
  GivenPoints moved = points;
  for (auto& point : moved) point = motion * *point;
  const auto here = solver.Find(points), there = solver.Find(moved);
  ASSERT_TRUE(here && there);
  const BoneTransforms before = ToTransforms(skeleton, here->pose);
  const BoneTransforms after = ToTransforms(skeleton, there->pose);
  for (int b = 0; b < kBoneCount; ++b) {
    const Rigidd expected = motion * before[b];
    EXPECT_LT((after[b].rotation - expected.rotation).norm(), 1e-5) << b;
    EXPECT_LT((after[b].translation - expected.translation).norm(), 1e-5) << b;
  }
}

TEST_F(InverseKinematicsOfABody, AnOutlierMovesTheOthersLittle) {
  const InverseKinematics solver(skeleton, {});
  GivenPoints points = PointsOf(skeleton, bones);
  const int elbow = static_cast<int>(BoneId::kLeftForearm);
  *points[elbow] += Vector3d(0.0, 0.3, 0.0);
  const auto found = solver.Find(points);
  ASSERT_TRUE(found);
  const std::vector<Vector3d> joints = PosedJoints(skeleton, ToTransforms(skeleton, found->pose));
  const std::vector<Vector3d> truth = PosedJoints(skeleton, bones);
  for (int b = 0; b < kBoneCount; ++b) {
    if (b == elbow || Bones()[b].parent == elbow) continue;
    EXPECT_LT((joints[b] - truth[b]).norm(), 0.06) << Bones()[b].name;
  }
}

TEST_F(InverseKinematicsOfABody, FindsNothingWithoutATrunk) {
  GivenPoints points = PointsOf(skeleton, bones);
  for (int p = 0; p < kBodyPointCount; ++p) {
    if (p != static_cast<int>(BoneId::kPelvis) && p != static_cast<int>(BoneId::kLeftHand))
      points[p].reset();
  }
  EXPECT_FALSE(InverseKinematics(skeleton, {}).Find(points));
}

// A stand-in for a detector: the true joints of an arm's scene with noise.
class NoisyJoints final : public JointFinder {
 public:
  explicit NoisyJoints(const BoneTransforms& bones, const Skeleton& skeleton)
      : truth_(PosedPoints(skeleton, bones)) {}

  GivenPoints Find(const DepthFrame& frame, const PinholeCamera&, double) const override {
    GivenPoints points;
    if (frame.index < 0) return points;
    RandomStream random(7, fmt::format("noise {}", frame.index));
    for (int b = 0; b < kBoneCount; ++b) {
      points[b] =
          truth_[b] + Vector3d::NullaryExpr([&](Eigen::Index) { return random.Normal(0.0, 0.01); });
    }
    return points;
  }

 private:
  BodyPointPositions truth_;
};

class SkeletonDrivenOnAnEasyScene : public ::testing::Test {
 protected:
  void SetUp() override {
    tracker = std::make_unique<SkeletonDriven>(Settings{},
                                               std::make_unique<NoisyJoints>(bones, body.skeleton));
    tracker->Start(body, camera);
  }

  const BodyModel body = TinyBody(2);
  const PinholeCamera camera{};
  const BoneTransforms bones = SomePose(body.skeleton);
  std::unique_ptr<SkeletonDriven> tracker;
};

TEST_F(SkeletonDrivenOnAnEasyScene, IsWithinTwoCentimetresOfNoisyJoints) {
  double error_m = 0.0;
  constexpr int kFrames = 20;
  for (int frame = 0; frame < kFrames; ++frame) {
    const TrackResult result =
        tracker->TrackFrame({frame, 0.0, DepthImage(camera.width, camera.height)});
    EXPECT_FALSE(IsFailure(result.outcome));
    error_m += MeanDistance(result.joints, PosedJoints(body.skeleton, bones)) / kFrames;
  }
  EXPECT_LT(error_m, 0.02);
}

TEST_F(SkeletonDrivenOnAnEasyScene, KeepsThePoseWhereNoJointsAreFound) {
  const DepthImage empty(camera.width, camera.height);
  const TrackResult first = tracker->TrackFrame({0, 0.0, empty});
  const TrackResult second = tracker->TrackFrame({-1, 0.0, empty});
  EXPECT_EQ(second.outcome, Outcome::kNoData);
  EXPECT_EQ(second.joints, first.joints);
  EXPECT_EQ(second.vertices, first.vertices);
}

TEST_F(SkeletonDrivenOnAnEasyScene, TheSurfaceFollowsTheBones) {
  const TrackResult result = tracker->TrackFrame({0, 0.0, DepthImage(camera.width, camera.height)});
  std::vector<Vector3f> expected;
  SkinLinear(body.rest.vertices, skinning::HeatWeights(body.rest, body.skeleton, {}),
             result.camera_from_rest, expected);
  EXPECT_EQ(result.vertices, expected);
}

TEST(SkeletonDrivenSettings, SayWhatIsMissing) {
  EXPECT_NE(Settings{}.Problem(), "");
  Settings settings;
  settings.joints = JointSource::kFile;
  EXPECT_NE(settings.Problem(), "");
  settings.observations = "joints.json";
  EXPECT_EQ(settings.Problem(), "");
}

}  // namespace
}  // namespace vitruvia::skeleton_driven
