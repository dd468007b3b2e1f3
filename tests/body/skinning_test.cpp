#include "body/skinning.h"

#include <functional>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "tests/support/tiny_body.h"

namespace vitruvia {
namespace {

using testing::HasSubstr;
using Vec = Vector3<double>;
using Skin = std::function<void(const std::vector<Vector3f>&, const SkinWeights&,
                                const BoneTransforms&, std::vector<Vector3f>&)>;

constexpr double kPi = std::numbers::pi;
constexpr double kTolerance_m = 2e-6;  // some float roundings of coordinates of a few metres

Rigidd RandomRigid(RandomStream& random) {
  const Vec axis = Vec(random.Normal(), random.Normal(), random.Normal()).normalized();
  return {ExpSo3<double>(random.Uniform(0.0, kPi) * axis),
          {random.Normal(), random.Normal(), random.Normal()}};
}

Rigidd TurnAboutX(double degrees) {
  return {ExpSo3<double>(Vec(degrees * kPi / 180.0, 0.0, 0.0)), Vec::Zero()};
}

// `count` vertices of which each follows bones 0 and 1 by half.
SkinWeights HalfAndHalf(std::size_t count) {
  SkinWeights weights;
  weights.bones.assign(count, {0, 1, 0, 0});
  weights.weights.assign(count, {0.5f, 0.5f, 0.0f, 0.0f});
  return weights;
}

// A ring of radius 0.1 round the x axis.
std::vector<Vector3f> Ring() {
  std::vector<Vector3f> ring;
  for (int i = 0; i < 12; ++i) {
    ring.push_back(
        Vec(0.3, 0.1 * std::cos(i * kPi / 6.0), 0.1 * std::sin(i * kPi / 6.0)).cast<float>());
  }
  return ring;
}

double RadiusAboutX(const Vector3f& p) { return std::hypot(p.y(), p.z()); }

class BothSkinnings : public testing::TestWithParam<std::pair<const char*, Skin>> {
 protected:
  std::vector<Vector3f> Posed(const BodyModel& body, const BoneTransforms& bones) const {
    std::vector<Vector3f> posed{{9.0f, 9.0f, 9.0f}};  // must be resized and overwritten
    GetParam().second(body.rest.vertices, body.weights, bones, posed);
    return posed;
  }
};

TEST_P(BothSkinnings, RestStaysAtRest) {
  const BodyModel body = TinyBody(2);
  const auto posed = Posed(body, BoneTransforms(kBoneCount));
  ASSERT_EQ(posed.size(), body.rest.vertices.size());
  for (std::size_t v = 0; v < posed.size(); ++v) {
    EXPECT_LT((posed[v] - body.rest.vertices[v]).norm(), 3e-7f);
  }
}

TEST_P(BothSkinnings, OneMotionOfAllBonesIsRigid) {
  const BodyModel body = TinyBody(2);
  RandomStream random(1, "one motion");
  for (int i = 0; i < 10; ++i) {
    const Rigidd motion = RandomRigid(random);
    const auto posed = Posed(body, BoneTransforms(kBoneCount, motion));
    for (std::size_t v = 0; v < posed.size(); ++v) {
      const Vec expected = motion * Vec(body.rest.vertices[v].cast<double>());
      EXPECT_LT((posed[v].cast<double>() - expected).norm(), kTolerance_m);
    }
  }
}

TEST_P(BothSkinnings, VerticesOfOneBoneFollowIt) {
  const BodyModel body = TinyBody(2);
  RandomStream random(2, "one bone");
  BoneTransforms bones;
  for (int b = 0; b < kBoneCount; ++b) bones.push_back(RandomRigid(random));
  const auto posed = Posed(body, bones);
  int count = 0;
  for (std::size_t v = 0; v < posed.size(); ++v) {
    if (body.weights.weights[v][0] < 1.0f) continue;
    ++count;
    const Vec expected =
        bones[body.weights.bones[v][0]] * Vec(body.rest.vertices[v].cast<double>());
    EXPECT_LT((posed[v].cast<double>() - expected).norm(), kTolerance_m);
  }
  EXPECT_GT(count, 100);
}

// A rigid motion after skinning is the same as one of all bones.
TEST_P(BothSkinnings, CommuteWithRigidMotions) {
  const BodyModel body = TinyBody(2);
  RandomStream random(3, "commute");
  BoneTransforms bones, moved;
  const Rigidd motion = RandomRigid(random);
  for (int b = 0; b < kBoneCount; ++b) {
    bones.push_back({ExpSo3<double>(0.5 * Vec(random.Uniform(), random.Uniform(), 0.0)),
                     {random.Uniform(), 0.0, 0.0}});
    moved.push_back(motion * bones.back());
  }
  const auto posed = Posed(body, bones), moved_posed = Posed(body, moved);
  for (std::size_t v = 0; v < posed.size(); ++v) {
    const Vec expected = motion * Vec(posed[v].cast<double>());
    EXPECT_LT((moved_posed[v].cast<double>() - expected).norm(), 2.0 * kTolerance_m);
  }
}

TEST_P(BothSkinnings, RefuseMisuse) {
  const BodyModel body = TinyBody();
  std::vector<Vector3f> posed;
  const Skin& skin = GetParam().second;
  SkinWeights shorter = body.weights;
  shorter.bones.pop_back();
  shorter.weights.pop_back();
  EXPECT_THROW(skin(body.rest.vertices, shorter, BoneTransforms(kBoneCount), posed),
               std::invalid_argument);
  EXPECT_THROW(skin(body.rest.vertices, body.weights, BoneTransforms(kBoneCount - 1), posed),
               std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Skinning, BothSkinnings,
                         testing::Values(std::pair{"Linear", Skin(SkinLinear)},
                                         std::pair{"DualQuaternion", Skin(SkinDualQuaternion)}),
                         [](const auto& which) { return std::string(which.param.first); });

TEST(SkinLinear, IsTheWeightedSumOfTheBones) {
  const BodyModel body = TinyBody(1);
  RandomStream random(4, "sum");
  BoneTransforms bones;
  for (int b = 0; b < kBoneCount; ++b) bones.push_back(RandomRigid(random));
  std::vector<Vector3f> posed;
  SkinLinear(body.rest.vertices, body.weights, bones, posed);
  for (std::size_t v = 0; v < posed.size(); ++v) {
    Vec expected = Vec::Zero();
    for (int k = 0; k < kMaxInfluences; ++k) {
      expected += body.weights.weights[v][k] *
                  (bones[body.weights.bones[v][k]] * Vec(body.rest.vertices[v].cast<double>()));
    }
    EXPECT_LT((posed[v].cast<double>() - expected).norm(), kTolerance_m);
  }
}

// The blend of the bones' matrices, one vertex after the other: the reference of the version that
// works on columns.
TEST(SkinLinear, GivesTheBitsOfBlendedMatrices) {
  using Matrix34f = Eigen::Matrix<float, 3, 4>;
  const BodyModel body = TinyBody(2);
  RandomStream random(5, "matrices");
  BoneTransforms bones;
  std::vector<Matrix34f> matrices(kBoneCount);
  for (int b = 0; b < kBoneCount; ++b) {
    bones.push_back(RandomRigid(random));
    matrices[b] << bones[b].rotation.cast<float>(), bones[b].translation.cast<float>();
  }
  std::vector<Vector3f> posed;
  SkinLinear(body.rest.vertices, body.weights, bones, posed);
  for (std::size_t v = 0; v < posed.size(); ++v) {
    Matrix34f blend = Matrix34f::Zero();
    for (int k = 0; k < kMaxInfluences; ++k)
      blend += body.weights.weights[v][k] * matrices[body.weights.bones[v][k]];
    const Vector3f expected = blend.leftCols<3>() * body.rest.vertices[v] + blend.col(3);
    EXPECT_EQ(posed[v], expected) << "vertex " << v;
  }
}

TEST(Twist, OfHalfATurnCollapsesLinearlyButNotInDualQuaternions) {
  const std::vector<Vector3f> ring = Ring();
  const BoneTransforms bones{TurnAboutX(0.0), TurnAboutX(180.0)};
  std::vector<Vector3f> linear, dual;
  SkinLinear(ring, HalfAndHalf(ring.size()), bones, linear);
  SkinDualQuaternion(ring, HalfAndHalf(ring.size()), bones, dual);
  for (std::size_t v = 0; v < ring.size(); ++v) {
    EXPECT_NEAR(RadiusAboutX(linear[v]), 0.0, 1e-7);
    EXPECT_NEAR(RadiusAboutX(dual[v]), 0.1, 1e-7);
    EXPECT_NEAR(dual[v].x(), 0.3f, 1e-7f);
  }
}

TEST(Twist, ShrinksLinearlyByTheCosineOfHalfTheAngle) {
  const std::vector<Vector3f> ring = Ring();
  for (const double degrees : {30.0, 90.0, 150.0}) {
    const BoneTransforms bones{TurnAboutX(0.0), TurnAboutX(degrees)};
    std::vector<Vector3f> linear, dual;
    SkinLinear(ring, HalfAndHalf(ring.size()), bones, linear);
    SkinDualQuaternion(ring, HalfAndHalf(ring.size()), bones, dual);
    const Rigidd half = TurnAboutX(degrees / 2.0);
    for (std::size_t v = 0; v < ring.size(); ++v) {
      EXPECT_NEAR(RadiusAboutX(linear[v]), 0.1 * std::cos(degrees * kPi / 360.0), 1e-7);
      EXPECT_LT((dual[v].cast<double>() - half * Vec(ring[v].cast<double>())).norm(), 1e-7);
    }
  }
}

// Made from rotation matrices, the quaternions of 230° and 250° have opposite signs; blent without
// a look at the hemisphere they would meet at 60° instead of 240°.
TEST(SkinDualQuaternion, BlendsTheShortWay) {
  const std::vector<Vector3f> ring = Ring();
  for (const double middle : {0.0, 60.0, 120.0, 180.0, 240.0, 300.0}) {
    const BoneTransforms bones{TurnAboutX(middle - 10.0), TurnAboutX(middle + 10.0)};
    std::vector<Vector3f> posed;
    SkinDualQuaternion(ring, HalfAndHalf(ring.size()), bones, posed);
    for (std::size_t v = 0; v < ring.size(); ++v) {
      const Vec expected = TurnAboutX(middle) * Vec(ring[v].cast<double>());
      EXPECT_LT((posed[v].cast<double>() - expected).norm(), 1e-6) << "about " << middle << "°";
    }
  }
}

TEST(Sparsified, KeepsTheFourLargest) {
  Eigen::MatrixXf dense(3, 6);
  dense << 0.05f, 0.4f, 0.0f, 0.3f, 0.15f, 0.1f,  //
      0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 2.0f,         //
      0.25f, 0.25f, 0.25f, 0.25f, 0.25f, 0.25f;
  const SkinWeights weights = Sparsified(dense);
  EXPECT_EQ(weights.bones[0], (std::array<std::uint8_t, 4>{1, 3, 4, 5}));
  EXPECT_FLOAT_EQ(weights.weights[0][0], 0.4f / 0.95f);
  EXPECT_FLOAT_EQ(weights.weights[0][3], 0.1f / 0.95f);
  EXPECT_EQ(weights.bones[1], (std::array<std::uint8_t, 4>{5, 0, 0, 0}));
  EXPECT_EQ(weights.weights[1], (std::array<float, 4>{1.0f, 0.0f, 0.0f, 0.0f}));
  EXPECT_EQ(weights.bones[2], (std::array<std::uint8_t, 4>{0, 1, 2, 3})) << "of equals the first";
  EXPECT_EQ(WeightsProblem(weights, 3, 6), "");
}

TEST(Sparsified, WorksWithFewerBonesThanSlots) {
  const SkinWeights weights = Sparsified(Eigen::MatrixXf::Ones(2, 2));
  EXPECT_EQ(weights.weights[1], (std::array<float, 4>{0.5f, 0.5f, 0.0f, 0.0f}));
  EXPECT_EQ(WeightsProblem(weights, 2, 2), "");
}

TEST(Sparsified, RefusesVerticesWithoutWeight) {
  EXPECT_THROW(Sparsified(Eigen::MatrixXf::Zero(1, 5)), std::invalid_argument);
  Eigen::MatrixXf nan = Eigen::MatrixXf::Ones(1, 5);
  nan(0, 2) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(Sparsified(nan), std::invalid_argument);
  EXPECT_THROW(Sparsified(Eigen::MatrixXf::Ones(1, 257)), std::invalid_argument);
}

TEST(Dense, IsUndoneBySparsified) {
  const SkinWeights weights = TinyBody(2).weights;
  const Eigen::MatrixXf dense = Dense(weights, kBoneCount);
  EXPECT_EQ(dense.rows(), static_cast<Eigen::Index>(weights.size()));
  EXPECT_TRUE(dense.rowwise().sum().isOnes(1e-6f));
  EXPECT_TRUE(Dense(Sparsified(dense), kBoneCount).isApprox(dense, 1e-6f));
}

TEST(WeightsProblem, NamesTheVertex) {
  const SkinWeights good = TinyBody().weights;
  EXPECT_EQ(WeightsProblem(good, good.size(), kBoneCount), "");
  EXPECT_EQ(WeightsProblem(good, 3, kBoneCount),
            fmt::format("weights for {} vertices, mesh of 3", good.size()));
  SkinWeights bad = good;
  bad.weights[5] = {0.5f, 0.25f, 0.0f, 0.0f};
  EXPECT_EQ(WeightsProblem(bad, bad.size(), kBoneCount),
            "vertex 5: weights sum to 0.75, expected 1");
  bad = good;
  bad.weights[6] = {1.5f, -0.5f, 0.0f, 0.0f};
  EXPECT_EQ(WeightsProblem(bad, bad.size(), kBoneCount),
            "vertex 6: weight -0.5, expected 0 or more");
  bad = good;
  bad.weights[7][0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(WeightsProblem(bad, bad.size(), kBoneCount), HasSubstr("vertex 7: weight nan"));
  bad = good;
  bad.bones[8][3] = kBoneCount;
  EXPECT_EQ(WeightsProblem(bad, bad.size(), kBoneCount),
            "vertex 8: bone 17, but there are 17 bones");
  bad = good;
  bad.weights[9] = {0.4f, 0.6f, 0.0f, 0.0f};
  EXPECT_THAT(WeightsProblem(bad, bad.size(), kBoneCount), HasSubstr("vertex 9: weights are not"));
}

}  // namespace
}  // namespace vitruvia
