#include "methods/capsule_icp/capsule.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "math/rigid.h"
#include "methods/capsule_icp/capsule_samples.h"
#include "methods/capsule_icp/posed_capsules.h"
#include "methods/capsule_icp/silhouette.h"
#include "support/body_states.h"
#include "synth/bodies/body_source.h"

namespace vitruvia::capsule_icp {
namespace {

const Capsule kTapered{0, {0.1, 0.2, 0.3}, {0.3, 0.6, 0.2}, 0.12, 0.05};

Vector3d Somewhere(RandomStream& random, double range) {
  return {random.Uniform(-range, range), random.Uniform(-range, range),
          random.Uniform(-range, range)};
}

// The least distance from the spheres along the segment, by trying many.
double TriedDistance(const Capsule& capsule, const Vector3d& x) {
  constexpr int kSteps = 20000;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kSteps; ++i) {
    const double t = static_cast<double>(i) / kSteps;
    const double radius = std::lerp(capsule.start_radius_m, capsule.end_radius_m, t);
    least =
        std::min(least, (x - capsule.start - t * (capsule.end - capsule.start)).norm() - radius);
  }
  return least;
}

TEST(Capsule, DistanceIsTheLeastOfItsSpheres) {
  RandomStream random(1, "points");
  for (int i = 0; i < 50; ++i) {
    const Vector3d x = Somewhere(random, 1.0);
    EXPECT_NEAR(DistanceFrom(kTapered, x).distance_m, TriedDistance(kTapered, x), 1e-7);
  }
}

TEST(Capsule, NormalIsTheGradientOfTheDistance) {
  constexpr double kStep = 1e-6;
  RandomStream random(2, "points");
  for (int i = 0; i < 50; ++i) {
    const Vector3d x = Somewhere(random, 1.0);
    Vector3d gradient;
    for (int k = 0; k < 3; ++k) {
      gradient[k] = (DistanceFrom(kTapered, x + kStep * Vector3d::Unit(k)).distance_m -
                     DistanceFrom(kTapered, x - kStep * Vector3d::Unit(k)).distance_m) /
                    (2.0 * kStep);
    }
    EXPECT_LT((DistanceFrom(kTapered, x).normal - gradient).norm(), 1e-5);
  }
}

TEST(Capsule, TheMeshAndTheSamplesLieOnIt) {
  const CapsuleMesh mesh = Meshed({kTapered}, 16);
  EXPECT_EQ(InspectMesh(mesh.mesh).problem, "");
  EXPECT_GT(EnclosedVolume(mesh.mesh), 0.0);
  for (const Vector3f& v : mesh.mesh.vertices) {
    EXPECT_NEAR(DistanceFrom(kTapered, v.cast<double>()).distance_m, 0.0, 1e-6);
  }
  const std::vector<SurfaceSample> samples = SampleCapsules({kTapered}, 0.03);
  EXPECT_GT(samples.size(), 100u);
  for (const SurfaceSample& sample : samples) {
    EXPECT_NEAR(DistanceFrom(kTapered, sample.place).distance_m, 0.0, 1e-9);
  }
}

class FittedCapsules : public testing::Test {
 protected:
  const BodyModel body_ = Refine(MakeControlBody(BodySettings{}), {.subdivisions = 1});
  const std::vector<Capsule> capsules_ = FitCapsules(body_, 2);
};

// The capsules of a round mannequin are near its surface.
TEST_F(FittedCapsules, AreNearTheSurface) {
  double sum = 0.0;
  for (const Vector3f& v : body_.rest.vertices) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Capsule& c : capsules_) {
      nearest = std::min(nearest, DistanceFrom(c, v.cast<double>()).distance_m);
    }
    sum += std::abs(nearest);
  }
  EXPECT_EQ(capsules_.size(), 20u);
  EXPECT_LT(sum / static_cast<double>(body_.rest.vertices.size()), 0.012);
}

// Learnt weights may leave a bone of the trunk without a vertex of its own.
TEST_F(FittedCapsules, ABoneWithoutSkinHasNone) {
  const auto chest = static_cast<std::uint8_t>(BoneId::kChest);
  BodyModel body = body_;
  for (auto& bones : body.weights.bones)
    std::replace(bones.begin(), bones.end(), chest, static_cast<std::uint8_t>(BoneId::kAbdomen));
  const std::vector<Capsule> capsules = FitCapsules(body, 2);
  EXPECT_EQ(capsules.size(), 18u);
  for (const Capsule& capsule : capsules) EXPECT_NE(capsule.bone, chest);
  for (auto& weights : body.weights.weights) weights.fill(0.25f);
  EXPECT_THROW(FitCapsules(body, 2), DataError);
}

TEST_F(FittedCapsules, OnePointIsComparedWithAllAsOneByOne) {
  const ShapedBody shaped = RigidShape(body_, 1000);
  const BoneTransforms bones = WorldFromRest(shaped, RandomState(30.0, 3));
  PosedCapsules posed(capsules_);
  posed.Pose(bones);
  RandomStream random(4, "points");
  for (int i = 0; i < 200; ++i) {
    const Vector3d x = Vector3d(0.05, 0.0, 2.8) + Somewhere(random, 1.0);
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < static_cast<int>(capsules_.size()); ++k) {
      least = std::min(least, DistanceFrom(posed.InCamera(k), x).distance_m);
    }
    const PosedCapsules::Nearest nearest = posed.FindNearest(x.cast<float>());
    EXPECT_NEAR(nearest.distance_m, least, 1e-5);
    const CapsuleDistance exact = DistanceFrom(posed.InCamera(nearest.capsule), x);
    EXPECT_LT((nearest.normal.cast<double>() - exact.normal).norm(), 1e-3);
  }
}

TEST(Silhouette, FindsTheNearestMeasuredPixel) {
  const PinholeCamera camera{64, 48, 60.0, 60.0, 31.5, 23.5};
  constexpr int kReach_px = 12;
  DepthImage depth(64, 48);
  RandomStream random(5, "pixels");
  std::vector<Pixel> measured;
  for (int i = 0; i < 12; ++i) {
    const Pixel pixel{static_cast<int>(random.Uniform(15.0, 45.0)),
                      static_cast<int>(random.Uniform(15.0, 35.0))};
    depth(pixel.u, pixel.v) = 2.0f;
    measured.push_back(pixel);
  }
  Silhouette silhouette(camera, kReach_px);
  silhouette.Observe(DepthImage(64, 48, 1.0f), 3.0f);  // of another frame
  silhouette.Observe(depth, 3.0f);
  for (int v = 6; v < 46; ++v) {
    for (int u = 6; u < 56; ++u) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Pixel& p : measured) nearest = std::min(nearest, std::hypot(p.u - u, p.v - v));
      const std::optional<Pixel> found = silhouette.NearestTo({u, v});
      if (nearest > kReach_px) continue;
      ASSERT_TRUE(found);
      EXPECT_EQ(depth(found->u, found->v), 2.0f);
      EXPECT_LT(std::hypot(found->u - u, found->v - v), nearest + 0.5);
    }
  }
  silhouette.Observe(DepthImage(64, 48), 3.0f);
  EXPECT_FALSE(silhouette.NearestTo({30, 20}));
}

}  // namespace
}  // namespace vitruvia::capsule_icp
