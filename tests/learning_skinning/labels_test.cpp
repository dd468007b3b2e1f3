#include "learning/skinning/labels.h"

#include <stdexcept>

#include <gmock/gmock.h>

namespace vitruvia::skinning {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// A strip of triangles over vertices 0 … 7.
std::vector<Triangle> Strip() {
  std::vector<Triangle> triangles;
  for (int v = 0; v + 2 < 8; ++v) triangles.push_back({v, v + 1, v + 2});
  return triangles;
}

TEST(Labels, NeighboursShareEdges) {
  const Labels labels = {0, 0, 0, 1, 1, 1, 3, 3};
  const BoneGraph neighbours = NeighboursOnSurface(labels, Strip(), 4, 3);
  EXPECT_THAT(neighbours[0], ElementsAre(1));
  EXPECT_THAT(neighbours[1], ElementsAre(0, 3));
  EXPECT_THAT(neighbours[2], IsEmpty());
  EXPECT_THAT(neighbours[3], ElementsAre(1));
}

TEST(Labels, TheNeighboursOfMostSharedEdgesAreKept) {
  // Bone 0 shares two edges' triangles with bone 2, fewer with bone 1.
  const Labels labels = {1, 0, 0, 2, 2, 0, 0, 0};
  const BoneGraph neighbours = NeighboursOnSurface(labels, Strip(), 3, 1);
  EXPECT_THAT(neighbours[0], ElementsAre(2));
  EXPECT_THAT(neighbours[1], ElementsAre(0));
}

TEST(Labels, BonesWithinStepsComeNearestFirst) {
  const BoneGraph chain = {{1}, {0, 2}, {1, 3}, {2}};
  EXPECT_THAT(BonesWithin(chain, 0, 9)[1], ElementsAre(1));
  EXPECT_THAT(BonesWithin(chain, 1, 9)[1], ElementsAre(1, 0, 2));
  EXPECT_THAT(BonesWithin(chain, 2, 9)[1], ElementsAre(1, 0, 2, 3));
  EXPECT_THAT(BonesWithin(chain, 2, 3)[1], ElementsAre(1, 0, 2));
  EXPECT_THAT(BonesWithin(chain, 3, 9)[3], ElementsAre(3, 2, 1, 0));
}

TEST(Labels, TheHeaviestBoneIsTheLabel) {
  SkinWeights weights;
  weights.bones = {{4, 2, 0, 0}, {7, 0, 0, 0}};
  weights.weights = {{0.7f, 0.3f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f, 0.0f}};
  EXPECT_THAT(HeaviestBones(weights), ElementsAre(4, 7));
}

TEST(Labels, ProblemsAreNamed) {
  EXPECT_EQ(LabelsProblem(Labels{0, 1}, 2, 2), "");
  EXPECT_EQ(LabelsProblem(Labels{0, 2}, 2, 2), "vertex 1: label 2, but there are 2 bones");
  EXPECT_EQ(LabelsProblem(Labels{0}, 2, 2), "labels for 1 vertices, mesh of 2");
  EXPECT_EQ(LabelsProblem(Labels{}, 0, 257), "257 bones, expected 1 to 256");
  EXPECT_THROW(BonesWithin({{}}, 1, 0), std::invalid_argument);
}

}  // namespace
}  // namespace vitruvia::skinning
