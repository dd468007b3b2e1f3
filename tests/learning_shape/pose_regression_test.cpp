// Deformations by the pose: what is put in must come out again.
#include "learning/shape/pose_regression.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "core/random.h"
#include "learning/shape/scape_mesh.h"
#include "math/rotation.h"
#include "support/temporary_folder.h"
#include "support/tiny_body.h"

namespace vitruvia {
namespace {

std::array<Matrix3<double>, kBoneCount> RandomRotations(RandomStream& random, double deviation) {
  std::array<Matrix3<double>, kBoneCount> rotations;
  for (int b = 0; b < kBoneCount; ++b) {
    const Matrix3<double> local = ExpSo3<double>(
        Vector3d::NullaryExpr([&](Eigen::Index) { return random.Normal(0.0, deviation); }));
    const int parent = Bones()[b].parent;
    rotations[b] = parent < 0 ? local : Matrix3<double>(rotations[parent] * local);
  }
  return rotations;
}

double LargestDifference(const std::vector<Matrix3<double>>& a,
                         const std::vector<Matrix3<double>>& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, (a[k] - b[k]).norm());
  return largest;
}

class PoseRegressionOfABody : public ::testing::Test {
 protected:
  const BodyModel body = TinyBody(2);
  const std::vector<int> bones = TriangleBones(body.rest.triangles, body.weights);
};

TEST_F(PoseRegressionOfABody, FindsTheRotationsOfRigidParts) {
  RandomStream random(3, "rotations");
  const auto wanted = RandomRotations(random, 0.4);
  // Each triangle's corners turned with its own part: no corner is shared.
  std::vector<Vector3f> rest, posed;
  std::vector<Triangle> triangles;
  for (std::size_t k = 0; k < bones.size(); ++k) {
    const int first = static_cast<int>(rest.size());
    triangles.push_back({first, first + 1, first + 2});
    for (const int v : body.rest.triangles[k]) {
      rest.push_back(body.rest.vertices[v]);
      posed.push_back(wanted[bones[k]].cast<float>() * body.rest.vertices[v]);
    }
  }
  const auto found = PartRotations(triangles, bones, rest, posed);
  for (int b = 0; b < kBoneCount; ++b) EXPECT_LT((found[b] - wanted[b]).norm(), 1e-5) << b;
}

TEST_F(PoseRegressionOfABody, RigidMotionDeformsNothing) {
  const Matrix3<double> turn = ExpSo3<double>({0.5, -0.3, 0.9});
  std::vector<Vector3f> posed;
  for (const Vector3f& v : body.rest.vertices)
    posed.push_back(turn.cast<float>() * v + Vector3f(0.3f, 0.1f, 2.0f));
  std::array<Matrix3<double>, kBoneCount> rotations;
  rotations.fill(turn);
  const PoseDeformations deformations(body.rest.triangles, bones, body.rest.vertices, 1e-3);
  const std::vector<Matrix3<double>> identities(bones.size(), Matrix3<double>::Identity());
  EXPECT_LT(LargestDifference(deformations.Of(rotations, posed), identities), 1e-4);
}

// Surfaces bent by a known linear model, integrated by the mesh solve, teach that model's surfaces.
TEST_F(PoseRegressionOfABody, LearnsAModelThatIsLinearInTheTurns) {
  RandomStream random(4, "examples");
  PoseRegression planted =
      LearnPoseRegression(body, {{body.skeleton, body.rest.vertices, {body.rest.vertices}}}, {});
  for (TrianglePoseModel& model : planted.triangles) {
    for (int r = 1; r < kRegressors; ++r) {
      if (model.joints[(r - 1) / 3] < 0) continue;
      model.terms[r] = 0.1f * Matrix3<float>::Identity();  // the same all over: smooth
    }
    model.terms[0].setIdentity();
  }
  const ScapeMesh mesh(body.rest);
  const auto surface = [&](const std::array<Matrix3<double>, kBoneCount>& rotations,
                           const PoseRegression& regression) {
    std::vector<Matrix3<double>> turned, q;
    const auto turns = JointRotationVectors(rotations);
    for (std::size_t k = 0; k < bones.size(); ++k) {
      turned.push_back(rotations[bones[k]]);
      q.push_back(DeformationOf(regression.triangles[k], turns));
    }
    std::vector<Vector3f> posed;
    for (const Vector3d& v : mesh.Solve(turned, q)) posed.push_back(v.cast<float>());
    return posed;
  };
  PosedPerson person{body.skeleton, body.rest.vertices, {}};
  for (int i = 0; i < 60; ++i)
    person.poses.push_back(surface(RandomRotations(random, 0.15), planted));
  const PoseRegression learnt = LearnPoseRegression(body, {person}, {1e-3, 1e-4});
  double with = 0.0, without = 0.0;
  for (int i = 0; i < 5; ++i) {
    const auto rotations = RandomRotations(random, 0.15);
    const std::vector<Vector3f> wanted = surface(rotations, planted);
    const auto found = PartRotations(body.rest.triangles, bones, body.rest.vertices, wanted);
    PoseRegression none = learnt;
    for (TrianglePoseModel& model : none.triangles) {
      model.terms.fill(Matrix3<float>::Zero());
      model.terms[0].setIdentity();
    }
    const std::vector<Vector3f> by_learnt = surface(found, learnt), by_none = surface(found, none);
    for (std::size_t v = 0; v < wanted.size(); ++v) {
      with += (by_learnt[v] - wanted[v]).norm();
      without += (by_none[v] - wanted[v]).norm();
    }
  }
  EXPECT_LT(with, 0.5 * without);
}

TEST_F(PoseRegressionOfABody, GivesItsOwnMeshBack) {
  const PoseRegression learnt =
      LearnPoseRegression(body, {{body.skeleton, body.rest.vertices, {body.rest.vertices}}}, {});
  const PoseRegression same = OnMesh(learnt, body);
  ASSERT_EQ(same.triangles.size(), learnt.triangles.size());
  for (std::size_t k = 0; k < bones.size(); ++k) {
    EXPECT_EQ(same.triangles[k].bone, learnt.triangles[k].bone);
    EXPECT_EQ(same.triangles[k].place, learnt.triangles[k].place);
  }
}

TEST_F(PoseRegressionOfABody, IsReadAsItWasWrittenAndRefusedWhenDamaged) {
  const TemporaryFolder folder;
  PoseRegression learnt =
      LearnPoseRegression(body, {{body.skeleton, body.rest.vertices, {body.rest.vertices}}}, {});
  learnt.triangles[5].terms[3](1, 2) = 0.25f;
  WritePoseRegression(folder / "q", learnt, {});
  const PoseRegression read = ReadPoseRegression(folder / "q");
  for (std::size_t k = 0; k < bones.size(); ++k)
    EXPECT_EQ(read.triangles[k].terms, learnt.triangles[k].terms);
  const std::string bytes = ReadWholeFile(folder / "q/triangles.bin");
  WriteWholeFile(folder / "q/triangles.bin", bytes.substr(0, bytes.size() - 1));
  EXPECT_THROW(ReadPoseRegression(folder / "q"), DataError);
  std::string wrong = bytes;
  wrong[0] = 99;  // a bone that is not there
  WriteWholeFile(folder / "q/triangles.bin", wrong);
  EXPECT_THROW(ReadPoseRegression(folder / "q"), DataError);
}

}  // namespace
}  // namespace vitruvia
