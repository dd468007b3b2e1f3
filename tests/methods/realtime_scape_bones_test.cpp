// What is predicted for bones, observed and unobserved, and with which vertices points are paired.
#include <algorithm>

#include <gtest/gtest.h>

#include "math/rotation.h"
#include "methods/posed_tiny_body.h"
#include "methods/realtime_scape/correspondences.h"
#include "methods/realtime_scape/prediction.h"

namespace vitruvia::realtime_scape {
namespace {

class BoneTest : public testing::Test, protected PosedTinyBody {};

TEST_F(BoneTest, PredictionKeepsVelocityAndLetsUnobservedJointsComeToRest) {
  const int forearm = static_cast<int>(BoneId::kLeftForearm);
  const Matrix3<double> turn = ExpSo3<double>({0.0, 0.1, 0.0});
  BodyPose last = rest;
  last[forearm].rotation = last[forearm].rotation * turn;
  PoseHistory history{last, rest, {}};
  const MotionSettings constant{.model = MotionModel::kConstantRotation};
  EXPECT_EQ(PredictPose(model, history, constant).pose[forearm].rotation, last[forearm].rotation);

  const MotionSettings velocity{.velocity_share = 1.0, .hidden_decay = 0.5};
  const auto predicted_turn = [&] {
    const Prediction p = PredictPose(model, history, velocity);
    return LogSo3<double>(
        Matrix3<double>(rest[forearm].rotation.transpose() * p.pose[forearm].rotation));
  };
  EXPECT_TRUE(predicted_turn().isApprox(Vector3d(0.0, 0.2, 0.0), 1e-9));
  history.visibility = Advanced(history.visibility, model, CountByBone(model, {}, {}), 0.05);
  EXPECT_EQ(history.visibility.frames_unobserved[forearm], 1);
  EXPECT_TRUE(predicted_turn().isApprox(Vector3d(0.0, 0.15, 0.0), 1e-9));

  // The whole body's own motion goes on too.
  BodyPose shifted = rest;
  for (BonePose& bone : shifted) bone.center += Vector3d(0.01, 0.0, 0.02);
  const Prediction p = PredictPose(model, {shifted, rest, {}}, velocity);
  for (int j = 0; j < kBoneCount; ++j) {
    EXPECT_TRUE(p.pose[j].center.isApprox(rest[j].center + Vector3d(0.02, 0.0, 0.04), 1e-9)) << j;
  }
}

TEST_F(BoneTest, PointsArePairedWithBonesThatLackThemAndWithUnobservedOnes) {
  const PosedSurface surface = Surface(rest);
  const int hand = static_cast<int>(BoneId::kLeftHand), chest = static_cast<int>(BoneId::kChest);
  std::vector<int> visible;
  VertexClasses classes;
  for (int i = 0; i < static_cast<int>(model.rest_vertices.size()); ++i) {
    const int bone = model.weights.bones[i][0];
    if (bone == hand) continue;  // out of sight
    visible.push_back(i);
    if (bone == chest) classes.near_surface.push_back(i);  // and the chest has its points
  }
  const BoneCounts counts = CountByBone(model, visible, classes);
  BoneVisibility visibility;
  const FitSettings fit;
  const SearchSettings reach{.growth_m = 0.02, .reach_m = 0.1};
  VertexCandidates candidates;
  const auto find = [&](const SearchSettings& search) {
    FindVertexCandidates(model, surface, visible, counts, visibility, search, candidates);
  };
  const auto has = [&](const std::vector<int>& vertices, int bone) {
    return std::any_of(vertices.begin(), vertices.end(),
                       [&](int i) { return model.weights.bones[i][0] == bone; });
  };
  find(reach);
  EXPECT_FALSE(has(candidates.vertices, chest));
  EXPECT_TRUE(has(candidates.of_explained, chest));
  EXPECT_FALSE(has(candidates.vertices, hand)) << "it was observed in the last frame";
  EXPECT_TRUE(has(candidates.vertices, static_cast<int>(BoneId::kHead)));
  EXPECT_DOUBLE_EQ(SearchRadius(hand, visibility, fit, reach), fit.pair_cutoff_m);

  visibility = Advanced(visibility, model, counts, 0.05);
  find(reach);
  EXPECT_TRUE(has(candidates.vertices, hand));
  EXPECT_DOUBLE_EQ(SearchRadius(hand, visibility, fit, reach), fit.pair_cutoff_m + 0.02);
  EXPECT_DOUBLE_EQ(SearchRadius(chest, visibility, fit, reach), fit.pair_cutoff_m);
  visibility = Advanced(visibility, model, counts, 0.05);
  EXPECT_DOUBLE_EQ(SearchRadius(hand, visibility, fit, reach), reach.reach_m);

  const SearchSettings paper{.candidates = PairCandidates::kVisible};
  find(paper);
  EXPECT_EQ(candidates.vertices, visible);
  EXPECT_TRUE(candidates.of_explained.empty());
}

}  // namespace
}  // namespace vitruvia::realtime_scape
