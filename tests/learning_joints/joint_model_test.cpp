// Joint detectors: their features, their trees, what they learn and how they are stored.
#include <algorithm>

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
    const WholeDepth view{depth, 8.0f, 1.0f};
    const FeaturePoint behind(camera, {0.0f, 0.0f, z + 0.05f});
    EXPECT_NEAR(inside.Of(view, behind), -0.05f, 1e-6f);
    EXPECT_NEAR(across.Of(view, behind), -0.05f - kBackground_m, 1e-6f);
  }
}

// Two images that one split tells apart, and one place in both.
class TreeOfTwoImages : public ::testing::Test {
 protected:
  const PinholeCamera camera{};
  const CroppedDepth near{Image<std::uint16_t>(camera.width, camera.height, 1900)};
  const CroppedDepth far{Image<std::uint16_t>(camera.width, camera.height, 2100)};
  const Vector3f position{0.0f, 0.0f, 2.0f};
  const FeaturePoint place{camera, position};
  const TreeSettings settings{.depth = 1, .least_pixels = 5, .candidates = 20};
  RandomStream random{1, "test"};
};

TEST_F(TreeOfTwoImages, TellsTwoPartsApartAndVotesForWhatEachKnows) {
  // Point 3 lies alike from all pixels of the near part, point 5 from those of the far one.
  std::vector<BodyPointPositions> points(80);
  std::vector<TrainingPixel> pixels;
  for (int i = 0; i < 80; ++i) {
    for (Vector3d& p : points[i])
      p = Vector3d(random.Normal(), random.Normal(), 2.0 + random.Normal());
    points[i][i % 2 == 0 ? 3 : 5] = Vector3d(0.1, 0.2, 2.0);
    pixels.push_back({i % 2 == 0 ? &near : &far, place, position, i % 2, &points[i]});
  }
  const VotingTree tree = GrowTree(pixels, settings, random);
  const PointVote& vote = tree.LeafOf(near, place)[0];
  EXPECT_EQ(vote.point, 3);
  EXPECT_NEAR(vote.deviation_m, 0.0f, 1e-6f);
  EXPECT_NEAR(vote.offset_m[1], 0.2f, 1e-6f);
  EXPECT_EQ(tree.LeafOf(far, place)[0].point, 5);
}

TEST_F(TreeOfTwoImages, MakesTheOffsetsOfAWalkToItsPointAgree) {
  std::vector<BodyPointPositions> points(80);
  std::vector<TrainingPixel> starts;
  for (int i = 0; i < 80; ++i) {
    points[i].fill(Vector3d::Zero());
    points[i][7] = Vector3d(i % 2 == 0 ? 0.1 : -0.1, 0.0, 2.0);
    starts.push_back({i % 2 == 0 ? &near : &far, place, position, 0, &points[i]});
  }
  const VotingTree tree = GrowWalkTree(starts, 7, settings, random);
  EXPECT_EQ(tree.LeafOf(near, place)[0].point, 7);
  EXPECT_EQ(tree.LeafOf(near, place)[1].point, -1);
  EXPECT_NEAR(tree.LeafOf(near, place)[0].offset_m[0], 0.1f, 1e-6f);
  EXPECT_NEAR(tree.LeafOf(far, place)[0].offset_m[0], -0.1f, 1e-6f);
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
    settings.trees = 2;
    settings.pixels_per_image = 60;
    settings.tree = {.depth = 10, .least_pixels = 4, .candidates = 15, .split_pixels = 200};
    settings.walks.trees = 2;
    settings.walks.starts_per_image = 40;
    settings.walks.tree = {.depth = 8, .least_pixels = 4, .candidates = 15, .split_pixels = 200};
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

TEST_F(LearntJoints, AreFoundInTheImagesThatWereLearntFrom) {
  const JointDetector detector(Model(), {.stride_px = 2});
  std::vector<double> errors_m;
  for (const JointExample& example : Images()) {
    const DetectedPoints found =
        detector.Detect(Whole(example), Examples().camera, kFarthest_m, 1.0);
    for (int p = 0; p < kBodyPointCount; ++p) {
      if (found[p]) errors_m.push_back((*found[p] - example.points[p]).norm());
    }
  }
  ASSERT_GT(errors_m.size(), 20 * Images().size());
  std::nth_element(errors_m.begin(), errors_m.begin() + errors_m.size() / 2, errors_m.end());
  EXPECT_LT(errors_m[errors_m.size() / 2], 0.08);
}

TEST_F(LearntJoints, FindNothingInAnEmptyImage) {
  const JointDetector detector(Model(), {});
  for (const auto& point :
       detector.Detect(DepthImage(160, 120), Examples().camera, kFarthest_m, 1.0)) {
    EXPECT_FALSE(point);
  }
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
    const Vector3d& pelvis = points[static_cast<int>(BoneId::kPelvis)];
    EXPECT_GE((points[static_cast<int>(BoneId::kLeftHand)] - pelvis).norm(),
              settings.trunk_clearance_m);
  }
}

}  // namespace
}  // namespace vitruvia::joints
