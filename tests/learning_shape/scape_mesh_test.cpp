// SCAPE's mesh solve by identities.
#include "learning/shape/scape_mesh.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "math/rotation.h"
#include "small_database.h"

namespace vitruvia {
namespace {

const TriangleMesh& Template() { return SmallDatabase().reference.rest; }

std::vector<Matrix3<double>> ForAll(const Matrix3<double>& matrix) {
  return std::vector<Matrix3<double>>(Template().triangles.size(), matrix);
}

double LargestDistance(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
  double largest = 0.0;
  for (std::size_t v = 0; v < a.size(); ++v) largest = std::max(largest, (a[v] - b[v]).norm());
  return largest;
}

std::vector<Vector3d> ToDouble(const std::vector<Vector3f>& vertices) {
  std::vector<Vector3d> result;
  for (const Vector3f& v : vertices) result.push_back(v.cast<double>());
  return result;
}

Vector3d MeanOf(const std::vector<Vector3d>& points) {
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& p : points) mean += p / static_cast<double>(points.size());
  return mean;
}

TEST(ScapeMesh, IdentitiesGiveTheTemplateBack) {
  const ScapeMesh mesh(Template());
  const auto identity = ForAll(Matrix3<double>::Identity());
  EXPECT_LT(LargestDistance(mesh.Solve(identity, identity), ToDouble(Template().vertices)), 1e-6);
}

TEST(ScapeMesh, OneRotationForAllTurnsTheTemplateAboutItsMean) {
  const ScapeMesh mesh(Template());
  const Matrix3<double> turn = ExpSo3<double>({0.3, -0.8, 0.5});
  std::vector<Vector3d> expected = ToDouble(Template().vertices);
  const Vector3d mean = MeanOf(expected);
  for (Vector3d& v : expected) v = turn * (v - mean) + mean;
  EXPECT_LT(
      LargestDistance(mesh.Solve(ForAll(turn), ForAll(Matrix3<double>::Identity())), expected),
      1e-5);
}

TEST(ScapeMesh, DeformationsOfAnotherPersonGiveThatPersonBack) {
  const ScapeMesh mesh(Template());
  const std::vector<Vector3f>& other = SmallDatabase().subjects[7].vertices;
  const Eigen::MatrixXd flat = mesh.Integrate(mesh.Deformations(other));
  std::vector<Vector3d> found(other.size()), wanted = ToDouble(other);
  for (std::size_t v = 0; v < other.size(); ++v)
    found[v] = flat.block<3, 1>(static_cast<Eigen::Index>(3 * v), 0) + MeanOf(wanted);
  EXPECT_LT(LargestDistance(found, wanted), 1e-5);
}

// A pull on one triangle: the solution is where the sum of squares is least, so no vertex gains by
// moving.
TEST(ScapeMesh, SolutionIsTheLeastSquaresOne) {
  const ScapeMesh mesh(Template());
  const auto identity = ForAll(Matrix3<double>::Identity());
  auto shape = identity;
  shape[100] *= 3.0;
  const auto energy = [&](const std::vector<Vector3d>& v) {
    double sum = 0.0;
    for (std::size_t k = 0; k < shape.size(); ++k) {
      const Triangle& t = Template().triangles[k];
      for (const int n : {1, 2}) {
        const Vector3d edge =
            (Template().vertices[t[n]] - Template().vertices[t[0]]).cast<double>();
        sum += (shape[k] * edge - (v[t[n]] - v[t[0]])).squaredNorm();
      }
    }
    return sum;
  };
  std::vector<Vector3d> solved = mesh.Solve(identity, shape);
  const double least = energy(solved);
  EXPECT_GT(least, 1e-6);
  for (const int corner : Template().triangles[100]) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double step : {-1e-4, 1e-4}) {
        std::vector<Vector3d> moved = solved;
        moved[static_cast<std::size_t>(corner)][axis] += step;
        EXPECT_GT(energy(moved), least);
      }
    }
  }
}

TEST(ScapeMesh, RefusesSeveralPieces) {
  TriangleMesh two = Template();
  TriangleMesh other = two;
  for (Vector3f& v : other.vertices) v.x() += 3.0f;
  AppendSurface(other.vertices, other.triangles, two);
  EXPECT_THROW(ScapeMesh{two}, DataError);
}

}  // namespace
}  // namespace vitruvia
