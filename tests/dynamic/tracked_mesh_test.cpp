#include "methods/dynamic/tracked_mesh.h"

#include <map>

#include <gtest/gtest.h>

#include "dynamic_fixtures.h"
#include "synth/bodies/body_source.h"

namespace vitruvia::dynamic {
namespace {

BodyModel Mannequin() {
  RefinementSettings refinement;
  refinement.subdivisions = 1;
  return Refine(MakeControlBody(BodySettings{}), refinement);
}

TEST(RigidSegments, AreClosedPartsThatFollowOneBoneEach) {
  const BodyModel body = Mannequin();
  const TrackedMesh mesh = RigidSegments(body);
  ASSERT_GT(mesh.vertices.size(), body.rest.vertices.size());
  for (std::size_t v = 0; v < body.rest.vertices.size(); ++v) {
    EXPECT_EQ(mesh.vertices[v], body.rest.vertices[v]);
    EXPECT_EQ(mesh.weights.bones[v][0], body.weights.bones[v][0]);
    EXPECT_EQ(mesh.weights.weights[v][0], 1.0f);
  }
  std::map<std::pair<int, int>, int> edges;
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(mesh.weights.bones[t[k]][0], mesh.weights.bones[t[0]][0]);
      ++edges[{t[k], t[(k + 1) % 3]}];
    }
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, edges[std::pair(edge.second, edge.first)]) << edge.first << edge.second;
  }
  // What was cut away are thin rings between the parts.
  const double whole = EnclosedVolume(body.rest);
  const double parts = EnclosedVolume({mesh.vertices, mesh.triangles});
  EXPECT_LT(parts, whole);
  EXPECT_GT(parts, 0.5 * whole);
}

TEST(SpreadVertices, TakesAboutTheShareThatWasAskedForOfEveryBone) {
  const TrackedMesh mesh = SmoothMesh(Mannequin());
  const std::vector<int> kept = SpreadVertices(mesh, 4);
  EXPECT_NEAR(static_cast<double>(kept.size()), static_cast<double>(mesh.vertices.size()) / 4.0,
              0.1 * static_cast<double>(mesh.vertices.size()));
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  std::vector<int> per_bone(kBoneCount, 0);
  const TrackedMesh subset = Subset(mesh, kept);
  for (const auto& bones : subset.weights.bones) ++per_bone[bones[0]];
  for (int bone = 0; bone < kBoneCount; ++bone) EXPECT_GT(per_bone[bone], 0) << bone;
  EXPECT_EQ(SpreadVertices(mesh, 1).size(), mesh.vertices.size());
}

}  // namespace
}  // namespace vitruvia::dynamic
