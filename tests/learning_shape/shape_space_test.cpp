#include "learning/shape/shape_space.h"

#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "learning/shape/attribute_subspace.h"
#include "learning/shape/tracking_template.h"
#include "small_database.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {

std::vector<int> Range(int first, int last) {
  std::vector<int> numbers(static_cast<std::size_t>(last - first));
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

ShapeSpace Learn(ShapeForm form, int components, int people = 30) {
  return LearnShapeSpace(SmallDatabase(), Range(0, people),
                         {.form = form, .components = components});
}

class ShapeSpaceForms : public testing::TestWithParam<ShapeForm> {};
INSTANTIATE_TEST_SUITE_P(, ShapeSpaceForms,
                         testing::Values(ShapeForm::kVertices, ShapeForm::kScape));

// Mannequins have three parameters: few components must be enough for people never seen.
TEST_P(ShapeSpaceForms, RepresentsHeldOutPeopleBetterWithEachComponent) {
  const ShapeSpace space = Learn(GetParam(), 8);
  const auto errors = HeldOutErrors(space, SmallDatabase(), Range(30, 40), {1, 3, 8});
  EXPECT_GT(errors[0].mean_m, errors[1].mean_m);
  EXPECT_LT(errors[1].mean_m, 0.0015);
  EXPECT_LT(errors[2].mean_m, 0.00002);
}

TEST_P(ShapeSpaceForms, CoefficientsAreStandardDeviations) {
  const ShapeSpace space = Learn(GetParam(), 5);
  const Eigen::MatrixXd basis = space.basis.cast<double>();
  const Eigen::MatrixXd inverse = basis.completeOrthogonalDecomposition().pseudoInverse();
  Eigen::MatrixXd thetas(5, 30);
  for (int s = 0; s < 30; ++s) {
    const std::vector<Vector3f>& vertices = SmallDatabase().subjects[s].vertices;
    Eigen::VectorXd flat(3 * vertices.size());
    Vector3d mean = Vector3d::Zero();
    for (const Vector3f& v : vertices) mean += v.cast<double>() / double(vertices.size());
    for (std::size_t v = 0; v < vertices.size(); ++v)
      flat.segment<3>(3 * v) = vertices[v].cast<double>() - mean;
    thetas.col(s) = inverse * (flat - space.mean.cast<double>());
  }
  const Eigen::MatrixXd covariance = thetas * thetas.transpose() / 29.0;
  EXPECT_LT(thetas.rowwise().mean().cwiseAbs().maxCoeff(), 0.02);
  EXPECT_LT((covariance.topLeftCorner(3, 3) - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(),
            0.02);
}

TEST(ShapeSpace, RegressesJointsAndAttributesOfHeldOutPeople) {
  const ShapeSpace space = Learn(ShapeForm::kVertices, 8);
  const DatabaseSubject& subject = SmallDatabase().subjects[35];
  const AttributeSubspace subspace(space, 8);
  const Eigen::VectorXd theta =
      subspace.Corrected(subspace.Nearest(subject.attributes), subject.attributes);
  const BodyModel body = PlacedBody(space, theta, subject.attributes.sex);
  EXPECT_NEAR(body.attributes.height_m, subject.attributes.height_m, 2e-5);
  EXPECT_NEAR(body.attributes.weight_kg, subject.attributes.weight_kg, 2e-3);
  float lowest = 1.0f;
  for (const Vector3f& v : body.rest.vertices) lowest = std::min(lowest, v.y());
  EXPECT_FLOAT_EQ(lowest, 0.0f);
  for (int b = 0; b < kBoneCount; ++b) {
    EXPECT_LT((body.skeleton.joints[b] - subject.skeleton.joints[b]).norm(), 0.006)
        << Bones()[b].joint;
  }
}

TEST(ShapeSpace, MovingOrthogonallyKeepsTheRegressedAttributes) {
  const ShapeSpace space = Learn(ShapeForm::kVertices, 8);
  const AttributeSubspace subspace(space, 8);
  ASSERT_EQ(subspace.orthogonal().cols(), 5);
  EXPECT_LT((space.attribute_basis * subspace.orthogonal()).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(
      (subspace.orthogonal().transpose() * subspace.orthogonal() - Eigen::MatrixXd::Identity(5, 5))
          .cwiseAbs()
          .maxCoeff(),
      1e-12);
}

TEST(ShapeSpace, FoundAgainOnDisk) {
  const TemporaryFolder folder;
  const ShapeSpace space = Learn(ShapeForm::kVertices, 4);
  WriteShapeSpace(folder.path() / "space", space);
  const ShapeSpace read = ReadShapeSpace(folder.path() / "space");
  EXPECT_EQ(read.mean, space.mean);
  EXPECT_EQ(read.basis, space.basis);
  EXPECT_EQ(read.joint_basis, space.joint_basis);
  EXPECT_EQ(read.attribute_basis, space.attribute_basis);
  EXPECT_EQ(read.density_kg_m3, space.density_kg_m3);
  EXPECT_EQ(read.place_basis, space.place_basis);
  std::filesystem::resize_file(folder.path() / "space" / "basis.bin", 100);
  EXPECT_THROW(ReadShapeSpace(folder.path() / "space"), DataError);
}

TEST(ShapeSpace, RefusesFewerPeopleThanComponents) {
  EXPECT_THROW(Learn(ShapeForm::kVertices, 8, 8), DataError);
}

TEST(TrackingTemplate, SelectsVerticesAndMapsBack) {
  const TriangleMesh& learning = SmallDatabase().reference.rest;
  const TrackingTemplate tracking = MakeTrackingTemplate(learning, 800);
  EXPECT_NEAR(static_cast<double>(tracking.kept.size()), 800.0, 8.0);
  const BodyModel small = OnTrackingMesh(SmallDatabase().reference, tracking);
  EXPECT_EQ(InspectMesh(small.rest).problem, "");
  const std::vector<Vector3f> back = PositionsOnLearningMesh(small.rest.vertices, tracking);
  const SkinWeights weights = WeightsOnLearningMesh(small.weights, tracking);
  EXPECT_EQ(WeightsProblem(weights, learning.vertices.size(), kBoneCount), "");
  for (std::size_t i = 0; i < tracking.kept.size(); ++i) {
    const auto v = static_cast<std::size_t>(tracking.kept[i]);
    EXPECT_LT((back[v] - learning.vertices[v]).norm(), 1e-6f);
    EXPECT_EQ(weights.bones[v][0], SmallDatabase().reference.weights.bones[v][0]);
  }
  for (std::size_t v = 0; v < back.size(); ++v)
    EXPECT_LT((back[v] - learning.vertices[v]).norm(), 0.02f);
}

}  // namespace
}  // namespace vitruvia
