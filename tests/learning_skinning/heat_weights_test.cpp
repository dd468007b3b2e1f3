// Heat-diffusion weights against what they are by definition, and a dense solve.
#include "learning/skinning/heat_weights.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "core/error.h"
#include "support/tiny_body.h"

namespace vitruvia::skinning {
namespace {

class HeatWeightsOfABody : public ::testing::Test {
 protected:
  const BodyModel body = TinyBody(3);
  const std::vector<BoneContact> contacts = NearestVisibleBones(body.rest, body.skeleton, 60.0);
};

TEST_F(HeatWeightsOfABody, SumToOneBeforeAnythingIsCutOff) {
  const Eigen::MatrixXd weights = HeatDistribution(body.rest, contacts, 1.0);
  EXPECT_LT((weights.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-9);
}

TEST_F(HeatWeightsOfABody, AreValidSkinWeights) {
  const SkinWeights weights = HeatWeights(body.rest, body.skeleton, {});
  EXPECT_EQ(WeightsProblem(weights, body.rest.vertices.size(), kBoneCount), "");
}

// The system written out densely, with the cotangents by the law of cosines.
TEST_F(HeatWeightsOfABody, AreThoseOfADenseSolve) {
  constexpr double kHeat = 0.7;
  const auto n = static_cast<Eigen::Index>(body.rest.vertices.size());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n, n), right_side(n, kBoneCount);
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(n);
  for (const Triangle& t : body.rest.triangles) {
    std::array<double, 3> opposite;  // edge lengths, squared
    for (int k = 0; k < 3; ++k) {
      opposite[k] = (body.rest.vertices[t[(k + 1) % 3]] - body.rest.vertices[t[(k + 2) % 3]])
                        .cast<double>()
                        .squaredNorm();
    }
    const double sum = opposite[0] + opposite[1] + opposite[2];
    const double squares =
        opposite[0] * opposite[0] + opposite[1] * opposite[1] + opposite[2] * opposite[2];
    const double area = 0.25 * std::sqrt(sum * sum - 2.0 * squares);  // Heron
    for (int k = 0; k < 3; ++k) {
      const int i = t[(k + 1) % 3], j = t[(k + 2) % 3];
      const double half_cotangent = (sum - 2.0 * opposite[k]) / (8.0 * area);
      system(i, i) += half_cotangent;
      system(j, j) += half_cotangent;
      system(i, j) -= half_cotangent;
      system(j, i) -= half_cotangent;
      areas[t[k]] += area / 3.0;
    }
  }
  right_side.setZero();
  for (Eigen::Index v = 0; v < n; ++v) {
    const BoneContact& contact = contacts[static_cast<std::size_t>(v)];
    if (contact.bones.empty()) continue;
    const double heating = areas[v] * kHeat / (contact.distance_m * contact.distance_m);
    system(v, v) += heating;
    for (const int b : contact.bones)
      right_side(v, b) += heating / static_cast<double>(contact.bones.size());
  }
  const Eigen::MatrixXd expected = system.partialPivLu().solve(right_side);
  const Eigen::MatrixXd found = HeatDistribution(body.rest, contacts, kHeat);
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_F(HeatWeightsOfABody, GiveTheMiddleOfALimbToItsBone) {
  const SkinWeights weights = HeatWeights(body.rest, body.skeleton, {});
  const Vector3d knee = body.skeleton.joints[static_cast<int>(BoneId::kLeftShin)];
  const Vector3d ankle = body.skeleton.joints[static_cast<int>(BoneId::kLeftFoot)];
  const Vector3d middle = 0.5 * (knee + ankle);
  int checked = 0;
  for (std::size_t v = 0; v < weights.size(); ++v) {
    const Vector3d vertex = body.rest.vertices[v].cast<double>();
    if (std::abs(vertex.y() - middle.y()) > 0.1 || std::abs(vertex.x() - middle.x()) > 0.15)
      continue;
    EXPECT_EQ(weights.bones[v][0], static_cast<int>(BoneId::kLeftShin));
    EXPECT_GT(weights.weights[v][0], 0.75f);
    ++checked;
  }
  EXPECT_GT(checked, 4);
}

// The nearest bone of a vertex on the inside of a thigh may be of the other leg; it is not seen.
TEST_F(HeatWeightsOfABody, NoVertexOfALegSeesABoneOfTheOther) {
  for (std::size_t v = 0; v < contacts.size(); ++v) {
    if (body.rest.vertices[v].y() > 0.6f) continue;
    for (const int bone : contacts[v].bones) {
      const double bone_x = body.skeleton.joints[bone].x();
      EXPECT_GT(bone_x * body.rest.vertices[v].x(), 0.0) << "vertex " << v << ", bone " << bone;
    }
  }
}

TEST_F(HeatWeightsOfABody, RefusesAMeshThatSeesNoBone) {
  const std::vector<BoneContact> none(body.rest.vertices.size());
  EXPECT_THROW(HeatDistribution(body.rest, none, 1.0), DataError);
}

}  // namespace
}  // namespace vitruvia::skinning
