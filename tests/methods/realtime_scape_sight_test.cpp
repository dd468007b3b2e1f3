// What is expected of bones, seen and unseen, and what points may pull at.
#include <algorithm>

#include <gtest/gtest.h>

#include "methods/posed_tiny_body.h"
#include "methods/realtime_scape/bone_sight.h"
#include "methods/realtime_scape/prediction.h"

namespace vitruvia::realtime_scape {
namespace {

class Sight : public testing::Test, protected PosedTinyBody {};

TEST_F(Sight, PredictionTurnsJointsOnAndLetsUnseenOnesComeToRest) {
  const int forearm = static_cast<int>(BoneId::kLeftForearm);
  const Matrix3<double> turn = ExpSo3<double>({0.0, 0.1, 0.0});
  BodyPose last = rest;
  last[forearm].rotation = last[forearm].rotation * turn;
  BoneSight sight(model);
  const VertexClasses nothing;
  const MotionSettings constant{.model = MotionModel::kConstantRotation};
  EXPECT_EQ(PredictPose(model, last, rest, sight, constant).pose[forearm].rotation,
            last[forearm].rotation);

  const MotionSettings velocity{.velocity_share = 1.0, .hidden_decay = 0.5};
  const auto predicted_turn = [&] {
    const Prediction p = PredictPose(model, last, rest, sight, velocity);
    return LogSo3<double>(
        Matrix3<double>(rest[forearm].rotation.transpose() * p.pose[forearm].rotation));
  };
  EXPECT_TRUE(predicted_turn().isApprox(Vector3d(0.0, 0.2, 0.0), 1e-9));
  sight.Count(model, {}, nothing);
  sight.EndFrame(0.05);
  EXPECT_EQ(sight.frames_unseen(forearm), 1);
  EXPECT_TRUE(predicted_turn().isApprox(Vector3d(0.0, 0.15, 0.0), 1e-9));

  // The whole body's own motion goes on too.
  BodyPose shifted = rest;
  for (BonePose& bone : shifted) bone.center += Vector3d(0.01, 0.0, 0.02);
  BoneSight all_seen(model);
  const Prediction p = PredictPose(model, shifted, rest, all_seen, velocity);
  for (int j = 0; j < kBoneCount; ++j) {
    EXPECT_TRUE(p.pose[j].center.isApprox(rest[j].center + Vector3d(0.02, 0.0, 0.04), 1e-9)) << j;
  }
}

TEST_F(Sight, PointsMayPullAtBonesThatLackThemAndAtUnseenOnes) {
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
  BoneSight sight(model);
  sight.Count(model, visible, classes);
  const FitSettings fit;
  const SearchSettings reach{.growth_m = 0.02, .reach_m = 0.1};
  CandidateFinder finder(model);
  std::vector<int> candidates, settled;
  const auto has = [&](const std::vector<int>& vertices, int bone) {
    return std::any_of(vertices.begin(), vertices.end(),
                       [&](int i) { return model.weights.bones[i][0] == bone; });
  };
  finder.Find(model, surface, visible, sight, reach, candidates, settled);
  EXPECT_FALSE(has(candidates, chest));
  EXPECT_TRUE(has(settled, chest));
  EXPECT_FALSE(has(candidates, hand)) << "it was seen a frame ago";
  EXPECT_TRUE(has(candidates, static_cast<int>(BoneId::kHead)));
  EXPECT_DOUBLE_EQ(ReachOf(hand, sight, fit, reach), fit.pair_cutoff_m);

  sight.EndFrame(0.05);
  finder.Find(model, surface, visible, sight, reach, candidates, settled);
  EXPECT_TRUE(has(candidates, hand));
  EXPECT_DOUBLE_EQ(ReachOf(hand, sight, fit, reach), fit.pair_cutoff_m + 0.02);
  EXPECT_DOUBLE_EQ(ReachOf(chest, sight, fit, reach), fit.pair_cutoff_m);
  sight.EndFrame(0.05);
  EXPECT_DOUBLE_EQ(ReachOf(hand, sight, fit, reach), reach.reach_m);

  const SearchSettings paper{.candidates = PairCandidates::kVisible};
  finder.Find(model, surface, visible, sight, paper, candidates, settled);
  EXPECT_EQ(candidates, visible);
  EXPECT_TRUE(settled.empty());
}

}  // namespace
}  // namespace vitruvia::realtime_scape
