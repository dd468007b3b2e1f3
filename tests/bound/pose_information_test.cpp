#include "bound/pose_information.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "bound/sequence_bound.h"
#include "core/random.h"
#include "geometry/surface_map.h"
#include "geometry/zbuffer.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "support/tiny_body.h"

namespace vitruvia {
namespace {

using Pose = Eigen::VectorXd;  // kPoseUnknowns: a translation, a rotation vector of each bone

constexpr double kSigma_m = 0.0005;

// A figure of boxes before a camera that sees it from the side, so that many faces slant.
class PoseInformationOfBoxes : public testing::Test {
 protected:
  PoseInformationOfBoxes() {
    Matrix3<double> facing;
    facing << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    const Matrix3<double> turn = ExpSo3<double>(Vector3d(0.1, 0.5, 0.05));
    camera_from_subject_ = {turn * facing, Vector3d(0.0, 0.9, 2.6)};
    for (int j = 0; j < kBoneCount; ++j)
      joints_[j] = camera_from_subject_ * body_.skeleton.joints[j];
    shares_ = SharesOf(body_.weights);
    vertices_ = Vertices(Pose::Zero(kPoseUnknowns));
    samples_ = SampleSurface(vertices_, body_.rest.triangles, camera_);
  }

  // Each bone's rotation about its joint, carried along by its ancestors'.
  BoneTransforms Bones(const Pose& pose) const {
    std::vector<Rigidd> moved(kBoneCount);
    BoneTransforms camera_from_rest;
    for (int j = 0; j < kBoneCount; ++j) {
      const int parent = vitruvia::Bones()[j].parent;
      const Rigidd above =
          parent < 0 ? Rigidd{Matrix3<double>::Identity(), pose.head<3>()} : moved[parent];
      moved[j] =
          above * RotationAbout<double>(ExpSo3<double>(pose.segment<3>(3 + 3 * j)), joints_[j]);
      camera_from_rest.push_back(moved[j] * camera_from_subject_);
    }
    return camera_from_rest;
  }
  std::vector<Vector3f> Vertices(const Pose& pose) const {
    std::vector<Vector3f> posed;
    SkinLinear(body_.rest.vertices, body_.weights, Bones(pose), posed);
    return posed;
  }
  Eigen::MatrixXd Information(const PixelNoise& noise, double shared_area_px = 1.0) const {
    const Image<PixelNoise> everywhere(camera_.width, camera_.height, noise);
    return PoseInformation({vertices_, body_.rest.triangles, shares_, joints_}, samples_,
                           everywhere, camera_, shared_area_px);
  }

  PinholeCamera camera_{.width = 80, .height = 60, .fx = 75, .fy = 75, .cx = 39.5, .cy = 29.5};
  BodyModel body_ = TinyBody(2);
  Rigidd camera_from_subject_;
  std::array<Vector3d, kBoneCount> joints_;
  RotationShares shares_;
  std::vector<Vector3f> vertices_;
  Image<SurfaceSample> samples_;
};

TEST_F(PoseInformationOfBoxes, SamplesAreThePictureOfTheZBuffer) {
  ZBuffer zbuffer(camera_);
  const DepthImage& reference = zbuffer.Render(vertices_, body_.rest.triangles);
  const DepthImage sampled = DepthOf(samples_);
  int covered = 0, different = 0;
  for (std::size_t i = 0; i < sampled.pixels().size(); ++i) {
    covered += reference.pixels()[i] > 0.0f ? 1 : 0;
    different += std::abs(sampled.pixels()[i] - reference.pixels()[i]) > 1e-4f ? 1 : 0;
  }
  EXPECT_GT(covered, 300);
  EXPECT_LE(different, covered / 100) << "rounding decides about pixels on edges";
}

TEST_F(PoseInformationOfBoxes, IsThatOfMovedSurfacePoints) {
  RandomStream random(3, "direction");
  const PixelNoise noise{0.004, 0.003, 0.7};
  const Eigen::MatrixXd information = Information(noise);
  EXPECT_TRUE(information.isApprox(information.transpose()));
  for (int trial = 0; trial < 5; ++trial) {
    Pose direction(kPoseUnknowns);
    for (double& value : direction) value = random.Normal();
    constexpr double kStep = 3e-3;
    const std::vector<Vector3f> after = Vertices(kStep * direction);
    const std::vector<Vector3f> before = Vertices(-kStep * direction);
    double expected = 0.0;
    for (const SurfaceSample& sample : samples_.pixels()) {
      if (sample.depth_m == 0.0f) continue;
      const SurfacePoint place{sample.triangle, sample.barycentric};
      const auto at = [&](const std::vector<Vector3f>& vertices) {
        return Vector3d(Evaluate(place, vertices.data(), body_.rest.triangles).cast<double>());
      };
      const Triangle& t = body_.rest.triangles[sample.triangle];
      const Vector3d normal = (vertices_[t[1]] - vertices_[t[0]])
                                  .cross(vertices_[t[2]] - vertices_[t[0]])
                                  .cast<double>()
                                  .normalized();
      const Vector3d point = at(vertices_);
      const double along = normal.dot(point / point.z()) * noise.axial_m;
      const double across =
          std::sqrt(1.0 - std::pow(normal.dot(point.normalized()), 2)) * noise.lateral_m;
      const double motion = normal.dot(at(after) - at(before)) / (2.0 * kStep);
      expected += noise.measured_share * motion * motion / (along * along + across * across);
    }
    EXPECT_NEAR(direction.dot(information * direction) / expected, 1.0, 2e-3);
  }
}

TEST_F(PoseInformationOfBoxes, JointsMoveAsTheSkeletonDoes) {
  RandomStream random(4, "direction");
  Pose direction(kPoseUnknowns);
  for (double& value : direction) value = random.Normal();
  constexpr double kStep = 1e-4;
  const auto after = PosedJoints(body_.skeleton, Bones(kStep * direction));
  const auto before = PosedJoints(body_.skeleton, Bones(-kStep * direction));
  for (int j = 0; j < kBoneCount; ++j) {
    const Vector3d expected = (after[j] - before[j]) / (2.0 * kStep);
    EXPECT_LT((JointMotion(j, joints_) * direction - expected).norm(), 1e-6) << j;
  }
}

TEST_F(PoseInformationOfBoxes, SharedNoiseCountsOnceForEachArea) {
  const PixelNoise noise{0.004, 0.003, 1.0};
  EXPECT_TRUE(Information(noise, 9.0).isApprox(Information(noise) / 9.0));
}

TEST_F(PoseInformationOfBoxes, IsNothingWherePixelsAreNotMeasured) {
  EXPECT_TRUE(Information({0.004, 0.003, 0.0}).isZero(0.0));
}

// Place and left upper arm are unknown, all else is known. Each trial draws noise for a picture of
// the true pose and fits the pose by Gauss-Newton on pictures, with derivatives from pictures too.
// A pixel that leaves its triangle takes no part: there depth jumps, which I(θ) does not count.
TEST_F(PoseInformationOfBoxes, AMaximumLikelihoodFitReachesTheBound) {
  constexpr int kUnknowns = 6, kTrials = 400, kSteps = 2;
  using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
  const int arm = static_cast<int>(BoneId::kLeftUpperArm);
  const int hand = static_cast<int>(BoneId::kLeftHand);
  const auto pose_of = [&](const Unknowns& unknowns) {
    Pose pose = Pose::Zero(kPoseUnknowns);
    pose.head<3>() = unknowns.head<3>();
    pose.segment<3>(3 + 3 * arm) = unknowns.tail<3>();
    return pose;
  };
  Eigen::MatrixXd information = Information({kSigma_m, 0.0, 1.0});
  for (int k = 3; k < kPoseUnknowns; ++k) {
    if (k < 3 + 3 * arm || k >= 6 + 3 * arm) information(k, k) += 1e12;
  }
  const double bound_m = std::sqrt(JointBounds(information, joints_)[hand].trace());

  const std::vector<SurfaceSample>& truth = samples_.pixels();
  const auto samples_at = [&](const Unknowns& unknowns) {
    return SampleSurface(Vertices(pose_of(unknowns)), body_.rest.triangles, camera_).pixels();
  };
  const auto stays = [&](const std::vector<SurfaceSample>& moved, std::size_t i) {
    return truth[i].depth_m > 0.0f && moved[i].depth_m > 0.0f &&
           moved[i].triangle == truth[i].triangle;
  };
  Eigen::MatrixXd derivatives = Eigen::MatrixXd::Zero(truth.size(), kUnknowns);
  for (int k = 0; k < kUnknowns; ++k) {
    constexpr double kStep = 2e-4;
    const std::vector<SurfaceSample> after = samples_at(kStep * Unknowns::Unit(k));
    const std::vector<SurfaceSample> before = samples_at(-kStep * Unknowns::Unit(k));
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (stays(after, i) && stays(before, i))
        derivatives(i, k) = (double{after[i].depth_m} - before[i].depth_m) / (2.0 * kStep);
    }
  }
  const Eigen::LLT<Eigen::MatrixXd> normal_equations(derivatives.transpose() * derivatives);

  RandomStream random(5, "noise");
  double squares_m2 = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Eigen::VectorXd measured(truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i)
      measured[i] = double{truth[i].depth_m} + random.Normal(0.0, kSigma_m);
    Unknowns unknowns = Unknowns::Zero();
    for (int step = 0; step < kSteps; ++step) {
      const std::vector<SurfaceSample> model = samples_at(unknowns);
      Eigen::VectorXd residuals = Eigen::VectorXd::Zero(truth.size());
      for (std::size_t i = 0; i < truth.size(); ++i) {
        if (stays(model, i)) residuals[i] = measured[i] - model[i].depth_m;
      }
      unknowns += normal_equations.solve(derivatives.transpose() * residuals);
    }
    squares_m2 +=
        (PosedJoints(body_.skeleton, Bones(pose_of(unknowns)))[hand] - joints_[hand]).squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(squares_m2 / kTrials) / bound_m, 1.0, 0.05);
}

TEST(RotationShares, AreTheWeightsBelowEachJoint) {
  const BodyModel body = TinyBody();
  const RotationShares shares = SharesOf(body.weights);
  const Eigen::MatrixXf weights = Dense(body.weights, kBoneCount);
  for (std::size_t v = 0; v < shares.size(); ++v) {
    EXPECT_NEAR(shares[v][0], 1.0f, 1e-6f);
    const int hand = static_cast<int>(BoneId::kLeftHand);
    const int forearm = static_cast<int>(BoneId::kLeftForearm);
    EXPECT_NEAR(shares[v][hand], weights(v, hand), 1e-6f);
    EXPECT_NEAR(shares[v][forearm], weights(v, forearm) + weights(v, hand), 1e-6f);
  }
}

TEST(TransferredWeights, AreTheSubjectsOnItsOwnSurface) {
  const BodyModel body = TinyBody(2);
  const SkinWeights transferred = TransferredWeights(body, body.rest.vertices);
  EXPECT_TRUE(Dense(transferred, kBoneCount).isApprox(Dense(body.weights, kBoneCount), 1e-4f));
}

TEST(SequenceBound, NeedsTruthAndASensorModel) {
  SequenceInfo info;
  for (const BoneInfo& bone : Bones()) info.joints.emplace_back(bone.joint);
  EXPECT_NE(SequenceBound::Problem(info), "");
  info.provenance = {{"scene", {{"sensor", {{"model", "ideal"}}}}}};
  EXPECT_EQ(SequenceBound::Problem(info), "");
  info.joints.pop_back();
  EXPECT_NE(SequenceBound::Problem(info), "");
}

}  // namespace
}  // namespace vitruvia
