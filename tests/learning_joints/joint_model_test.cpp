// Joint detectors: their features, their trees, what they learn and how they are stored.
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "math/rigid.h"
#include "support/temporary_folder.h"
#include "synth/joint_examples/joint_examples.h"

namespace vitruvia::joints {
namespace {

constexpr double kFarthest_m = 8.0;

// A square plate with an edge of 0.4 m before the camera.
DepthImage Plate(const PinholeCamera& camera, float z_m) {
  DepthImage depth(camera.width, camera.height);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Vector3f p = camera.Unproject<float>(static_cast<float>(u), static_cast<float>(v), z_m);
      if (std::abs(p.x()) < 0.2f && std::abs(p.y()) < 0.2f) depth(u, v) = z_m;
    }
  }
  return depth;
}

TEST(DepthFeature, DoesNotDependOnTheDistance) {
  const PinholeCamera camera;
  const DepthFeature inside{FeatureKind::kDepthAgainstPoint, 0.1f, -0.1f};
  const DepthFeature across{FeatureKind::kTwoDepths, 0.1f, 0.0f, 0.3f, 0.0f};
  for (const float z : {1.5f, 3.0f}) {
    const DepthImage depth = Plate(camera, z);
    const WholeDepth view{depth, 8.0f};
    const FeaturePoint behind(camera, {0.0f, 0.0f, z + 0.05f});
    EXPECT_NEAR(inside.Of(view, behind), -0.05f, 1e-6f);
    EXPECT_NEAR(across.Of(view, behind), -0.05f - kBackground_m, 1e-6f);
  }
}

TEST(RegressionTree, FindsTheFeatureThatTellsTwoKindsOfOffsetApart) {
  const PinholeCamera camera;
  CroppedDepth near{Image<std::uint16_t>(camera.width, camera.height, 1900)};
  CroppedDepth far{Image<std::uint16_t>(camera.width, camera.height, 2100)};
  const FeaturePoint point(camera, {0.0f, 0.0f, 2.0f});
  std::vector<Sample> samples;
  for (int i = 0; i < 40; ++i) {
    samples.push_back({&near, point, {0.1f, 0.0f, 0.0f}});
    samples.push_back({&far, point, {-0.1f, 0.2f, 0.0f}});
  }
  RandomStream random(1, "test");
  const RegressionTree tree =
      GrowTree(samples, {.depth = 3, .least_samples = 5, .candidates = 20}, 0.2, random);
  EXPECT_NEAR((tree.Offset(near, point) - Vector3f(0.1f, 0.0f, 0.0f)).norm(), 0.0f, 1e-6f);
  EXPECT_NEAR((tree.Offset(far, point) - Vector3f(-0.1f, 0.2f, 0.0f)).norm(), 0.0f, 1e-6f);
}

class LearntJoints : public ::testing::Test {
 protected:
  static JointExampleSettings Examples() {
    JointExampleSettings settings;
    settings.population.subjects = 2;
    settings.mesh.subdivisions = 1;
    settings.camera = {160, 120, 142.5, 142.5, 79.5, 59.5};
    settings.images = 60;
    return settings;
  }
  static ForestSettings Forests() {
    ForestSettings settings;
    settings.stages = {{0.04, 0.5}, {0.03, 0.3}};
    settings.trees = 3;
    settings.tree = {.depth = 6, .least_samples = 4, .candidates = 12, .split_samples = 100};
    return settings;
  }
  static const std::vector<JointExample>& Images() {
    static const std::vector<JointExample> examples = MakeJointExamples(Examples(), 2);
    return examples;
  }
  static const JointModel& Model() {
    static const JointModel model = LearnJoints(Images(), Examples().camera, Forests(), 2);
    return model;
  }
  static std::string Bytes(const JointModel& model) {
    const TemporaryFolder folder;
    WriteJointModel(folder / "model", model, {});
    return ReadWholeFile(folder / "model/trees.bin");
  }
  static DepthImage Whole(const JointExample& example) {
    DepthImage depth(160, 120);
    for (int v = 0; v < depth.height(); ++v) {
      for (int u = 0; u < depth.width(); ++u) depth(u, v) = example.depth.At(u, v);
    }
    return depth;
  }
};

TEST_F(LearntJoints, AreTheSameForAnyNumberOfThreads) {
  const std::vector<JointExample> alone = MakeJointExamples(Examples(), 1);
  ASSERT_EQ(alone.size(), Images().size());
  for (std::size_t i = 0; i < alone.size(); ++i) {
    ASSERT_EQ(alone[i].depth.depth_mm.pixels(), Images()[i].depth.depth_mm.pixels());
    ASSERT_EQ(alone[i].points, Images()[i].points);
  }
  EXPECT_EQ(Bytes(LearnJoints(alone, Examples().camera, Forests(), 1)), Bytes(Model()));
}

TEST_F(LearntJoints, AreNearerToTheTruthThanTheMeanOfThePoints) {
  const JointDetector detector(Model(), {.places = 4});
  double found_m = 0.0, centroid_m = 0.0;
  for (const JointExample& example : Images()) {
    const auto found = detector.Detect(Whole(example), Examples().camera, kFarthest_m);
    ASSERT_TRUE(found);
    for (int p = 0; p < kBodyPointCount; ++p) {
      found_m += ((*found)[p] - example.points[p]).norm();
      centroid_m += (example.centroid - example.points[p]).norm();
    }
  }
  EXPECT_LT(found_m, 0.3 * centroid_m);
}

TEST_F(LearntJoints, FindNothingInAnEmptyImage) {
  const JointDetector detector(Model(), {.places = 4});
  EXPECT_FALSE(detector.Detect(DepthImage(160, 120), Examples().camera, kFarthest_m));
}

TEST_F(LearntJoints, AreReadAsTheyWereWritten) {
  const TemporaryFolder folder;
  WriteJointModel(folder / "model", Model(), {{"images", 60}});
  EXPECT_EQ(Bytes(ReadJointModel(folder / "model")), Bytes(Model()));
  EXPECT_EQ(ReadLearntFrom(folder / "model").at("images"), 60);
}

TEST_F(LearntJoints, RefuseFilesThatAreCutOffOrLeadAstray) {
  const TemporaryFolder folder;
  WriteJointModel(folder / "model", Model(), {});
  const std::string whole = ReadWholeFile(folder / "model/trees.bin");
  const auto written = [&](const std::string& bytes) {
    WriteWholeFile(folder / "model/trees.bin", bytes);
    return folder / "model";
  };
  EXPECT_THROW(ReadJointModel(written(whole.substr(0, whole.size() - 4))), DataError);
  EXPECT_THROW(ReadJointModel(written(whole + "more")), DataError);
  std::string circle = whole;  // the root's children are the root
  circle.replace(24, 4, std::string(4, '\0'));
  EXPECT_THROW(ReadJointModel(written(circle)), DataError);
}

TEST(RandomPose, KeepsArmsClearOfTheTrunk) {
  const BodyModel body = Refine(MakeControlBody(BodySettings{}), {});
  RandomStream random(3, "poses");
  const RandomPoseSettings settings;
  for (int i = 0; i < 50; ++i) {
    const JointPose pose = DrawClearPose(settings, body.skeleton, random);
    const BodyPointPositions points =
        PosedPoints(body.skeleton, ForwardKinematics(body.skeleton, pose));
    const Vector3d pelvis = points[static_cast<int>(BoneId::kPelvis)];
    EXPECT_GE((points[static_cast<int>(BoneId::kLeftHand)] - pelvis).norm(),
              settings.trunk_clearance_m);
  }
}

}  // namespace
}  // namespace vitruvia::joints
