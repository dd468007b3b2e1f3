#include "methods/dynamic/surface.h"

#include <numbers>

#include <gtest/gtest.h>

#include "dynamic_fixtures.h"
#include "math/rigid.h"
#include "math/rotation.h"

namespace vitruvia::dynamic {
namespace {

TEST(SurfaceLayout, GivesEveryVertexOneSlotInAPatchOfItsBones) {
  const BodyModel body = BlendedBody();
  const SurfaceLayout layout(body.weights);
  EXPECT_EQ(layout.vertex_count(), static_cast<int>(body.rest.vertices.size()));
  std::vector<int> seen(layout.vertex_count(), 0);
  int end = 0;
  for (const Patch& patch : layout.patches) {
    EXPECT_EQ(patch.begin, end);
    EXPECT_EQ((patch.end - patch.begin) % kLanes, 0);
    EXPECT_LE(patch.end - patch.begin, kMaxPatchSlots);
    end = patch.end;
    for (int slot = patch.begin; slot < patch.end; ++slot) {
      const int v = layout.vertex_of_slot[slot];
      if (v < 0) continue;
      ++seen[v];
      EXPECT_EQ(layout.slot_of_vertex[v], slot);
      EXPECT_EQ(body.weights.bones[v][0], patch.bones[0]);
      int influences = 0;
      for (const float w : body.weights.weights[v]) influences += w > 0.0f ? 1 : 0;
      EXPECT_EQ(influences, patch.influences);
    }
  }
  EXPECT_EQ(end, layout.slot_count());
  EXPECT_EQ(seen, std::vector<int>(layout.vertex_count(), 1));
}

TEST(Surface, PosesAsPlainDualQuaternionSkinningDoes) {
  const BodyModel body = BlendedBody();
  const KinematicTree tree(HumanSkeleton(), body.skeleton);
  auto surface = SurfaceOf<float>(SmoothMesh(body));
  for (const std::uint64_t seed : {1, 2, 3}) {
    TreePose pose;
    tree.Pose(CameraFromStart(), RandomTheta(tree, 1.2, seed), pose);
    PoseAll(pose, surface);
    BoneTransforms bones;
    for (const auto& bone : pose.camera_from_rest) bones.push_back(bone.ToRigid());
    std::vector<Vector3f> expected;
    SkinDualQuaternion(body.rest.vertices, body.weights, bones, expected);
    for (std::size_t v = 0; v < expected.size(); ++v) {
      EXPECT_LT((surface.posed.At(surface.layout.slot_of_vertex[v]) - expected[v]).norm(), 3e-6f)
          << v;
    }
  }
}

TEST(Surface, RigidMotionInRigidMotionOut) {
  const BodyModel body = BlendedBody();
  auto surface = SurfaceOf<double>(SmoothMesh(body));
  const Rigidd motion{ExpSo3<double>({0.4, -2.0, 0.8}), {0.3, -0.2, 2.5}};
  TreePose pose;
  pose.camera_from_rest.fill(DualQuaternion<double>::FromRigid(motion));
  PoseAll(pose, surface);
  for (int v = 0; v < surface.layout.vertex_count(); ++v) {
    const int slot = surface.layout.slot_of_vertex[v];
    EXPECT_LT((surface.posed.At(slot) - motion * surface.rest.At(slot)).norm(), 1e-12);
    EXPECT_LT((surface.normals.At(slot) - motion.rotation * surface.rest_normals.At(slot)).norm(),
              1e-12);
  }
}

// q and −q are the same motion, so which of the two a bone comes with must not show.
TEST(Surface, DoesNotSeeTheSignOfABonesDualQuaternion) {
  const BodyModel body = BlendedBody();
  const KinematicTree tree(HumanSkeleton(), body.skeleton);
  TreePose pose, flipped;
  tree.Pose(CameraFromStart(), RandomTheta(tree, 1.0, 11), pose);
  flipped = pose;
  for (int bone = 0; bone < kBoneCount; bone += 2) {
    flipped.camera_from_rest[bone].real.coeffs() *= -1.0;
    flipped.camera_from_rest[bone].dual.coeffs() *= -1.0;
  }
  auto one = SurfaceOf<double>(SmoothMesh(body)), other = one;
  PoseAll(pose, one);
  PoseAll(flipped, other);
  for (int slot = 0; slot < one.layout.slot_count(); ++slot) {
    EXPECT_LT((one.posed.At(slot) - other.posed.At(slot)).norm(), 1e-12);
  }
}

// A forearm turned by 180 degrees against the upper arm: points between keep their distance from
// the axis, where linear blending pulls them onto it.
TEST(Surface, DoesNotCollapseOnATwist) {
  SkinWeights weights;
  weights.bones = {{0, 1, 0, 0}};
  weights.weights = {{0.5f, 0.5f, 0.0f, 0.0f}};
  const std::vector<Vector3f> rest{{0.5f, 0.04f, 0.0f}}, normals{{0.0f, 1.0f, 0.0f}};
  Surface<double> surface(weights, rest, normals);
  TreePose pose;
  const Matrix3<double> twist = ExpSo3<double>({std::numbers::pi - 1e-6, 0.0, 0.0});
  pose.camera_from_rest[1] = DualQuaternion<double>::FromRigid({twist, Vector3d::Zero()});
  PoseAll(pose, surface);
  const Vector3d posed = surface.posed.At(0);
  EXPECT_NEAR(std::hypot(posed.y(), posed.z()), 0.04, 1e-9);
  std::vector<Vector3f> linear;
  SkinLinear(rest, weights, {Rigidd{}, Rigidd{twist, Vector3d::Zero()}}, linear);
  EXPECT_LT(std::hypot(linear[0].y(), linear[0].z()), 1e-5);
}

}  // namespace
}  // namespace vitruvia::dynamic
