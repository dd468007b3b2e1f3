#include "geometry/mesh.h"

#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "math/rotation.h"
#include "support/shapes.h"

namespace vitruvia {
namespace {

using shapes::Cube;
using shapes::Joined;
using shapes::Sphere;
using shapes::Torus;
using testing::HasSubstr;

constexpr double kSphereVolume = 4.0 / 3.0 * std::numbers::pi;

TriangleMesh CubeOfTriangles() { return Triangulated(Cube()); }

void Flip(TriangleMesh& mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
}

TEST(Triangulated, SplitsAlongTheShorterDiagonal) {
  // A kite: corners 1 and 3 are near each other, 0 and 2 far apart.
  const QuadMesh kite{{{-2, 0, 0}, {0, -1, 0}, {2, 0, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}};
  const TriangleMesh mesh = Triangulated(kite);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  for (const Triangle& t : mesh.triangles) {
    EXPECT_THAT(t, testing::AllOf(testing::Contains(1), testing::Contains(3)));
    const Vector3f normal = (mesh.vertices[t[1]] - mesh.vertices[t[0]])
                                .cross(Vector3f(mesh.vertices[t[2]] - mesh.vertices[t[0]]));
    EXPECT_GT(normal.z(), 0.0f) << "orientation is kept";
  }
}

TEST(EnclosedVolume, OfACubeIsExactWhereverItStands) {
  TriangleMesh cube = CubeOfTriangles();
  EXPECT_EQ(EnclosedVolume(cube), 8.0);
  for (Vector3f& v : cube.vertices) v += Vector3f(1000, -2000, 500);
  EXPECT_EQ(EnclosedVolume(cube), 8.0);
  Flip(cube);
  EXPECT_EQ(EnclosedVolume(cube), -8.0) << "inside out";
}

TEST(EnclosedVolume, ConvergesToTheSphereQuadratically) {
  double last_error = kSphereVolume;
  for (int steps = 1; steps <= 5; ++steps) {
    const double error = kSphereVolume - EnclosedVolume(Triangulated(Sphere(steps)));
    EXPECT_GT(error, 0.0) << "an inscribed polyhedron is smaller";
    EXPECT_LT(error, 0.31 * last_error);
    last_error = error;
  }
  EXPECT_LT(last_error, 0.01);
}

TEST(EnclosedVolume, OfATorusFollowsPappus) {
  const double expected = 2.0 * std::numbers::pi * std::numbers::pi * 0.4 * 0.4;
  EXPECT_NEAR(EnclosedVolume(Triangulated(Torus(200, 100))), expected, 0.002 * expected);
}

TEST(EnclosedVolume, OfNothingIsZero) { EXPECT_EQ(EnclosedVolume({}), 0.0); }

TEST(BoundingBoxDiagonal, HasKnownValues) {
  EXPECT_DOUBLE_EQ(BoundingBoxDiagonal(Cube().vertices), std::sqrt(12.0));
  EXPECT_DOUBLE_EQ(BoundingBoxDiagonal({{-1, 5, 2}, {2, 1, 2}}), 5.0);
  EXPECT_EQ(BoundingBoxDiagonal({{7, 7, 7}}), 0.0);
  EXPECT_EQ(BoundingBoxDiagonal({}), 0.0);
}

TEST(ComputeVertexNormals, OnASphereAreThePositions) {
  const TriangleMesh sphere = Triangulated(Sphere(5));
  std::vector<Vector3f> normals;
  ComputeVertexNormals(sphere.vertices, sphere.triangles, normals);
  ASSERT_EQ(normals.size(), sphere.vertices.size());
  for (std::size_t v = 0; v < normals.size(); ++v) {
    EXPECT_NEAR(normals[v].norm(), 1.0f, 1e-6f);
    EXPECT_GT(normals[v].dot(sphere.vertices[v]), std::cos(0.02)) << "vertex " << v;
  }
}

TEST(ComputeVertexNormals, WeighByArea) {
  // Two triangles at vertex 0: one in the xy plane with twice the area of the one in the yz plane.
  const std::vector<Vector3f> vertices{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<Vector3f> normals;
  ComputeVertexNormals(vertices, {{0, 1, 2}, {0, 2, 3}}, normals);
  EXPECT_TRUE(normals[0].isApprox(Vector3f(1, 0, 2).normalized()));
  EXPECT_TRUE(normals[1].isApprox(Vector3f::UnitZ()));
  EXPECT_TRUE(normals[3].isApprox(Vector3f::UnitX()));
}

TEST(ComputeVertexNormals, AreZeroWithoutArea) {
  std::vector<Vector3f> normals;
  ComputeVertexNormals({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 0, 0}}, {{0, 1, 2}}, normals);
  for (const Vector3f& normal : normals) EXPECT_EQ(normal, Vector3f(0, 0, 0));
}

TEST(ComputeVertexNormals, TurnWithTheMesh) {
  TriangleMesh torus = Triangulated(shapes::Shaken(Torus(12, 8), 0.05f));
  std::vector<Vector3f> before, after;
  ComputeVertexNormals(torus.vertices, torus.triangles, before);
  const Matrix3<float> rotation = ExpSo3<float>({0.3f, -1.2f, 0.7f});
  for (Vector3f& v : torus.vertices) v = rotation * v + Vector3f(1, 2, 3);
  ComputeVertexNormals(torus.vertices, torus.triangles, after);
  for (std::size_t v = 0; v < before.size(); ++v) {
    EXPECT_LT((rotation * before[v] - after[v]).norm(), 1e-4f);
  }
}

TEST(InspectMesh, AcceptsCubeSphereAndTorus) {
  for (const auto& [mesh, euler] : {std::pair{CubeOfTriangles(), 2},
                                    {Triangulated(Sphere(3)), 2},
                                    {Triangulated(Torus(10, 6)), 0}}) {
    const MeshReport report = InspectMesh(mesh);
    EXPECT_EQ(report.problem, "");
    EXPECT_TRUE(report.closed);
    EXPECT_EQ(report.components, 1);
    EXPECT_EQ(report.euler_characteristic, euler);
  }
}

TEST(InspectMesh, FindsAnOpenEdge) {
  TriangleMesh mesh = CubeOfTriangles();
  mesh.triangles.pop_back();
  const MeshReport report = InspectMesh(mesh);
  EXPECT_FALSE(report.closed);
  EXPECT_THAT(report.problem, HasSubstr("open edge"));
}

TEST(InspectMesh, FindsATurnedTriangle) {
  TriangleMesh mesh = CubeOfTriangles();
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  const MeshReport report = InspectMesh(mesh);
  EXPECT_TRUE(report.closed);
  EXPECT_THAT(report.problem, HasSubstr("oriented against each other"));
}

TEST(InspectMesh, FindsAnEdgeOfThreeFaces) {
  TriangleMesh mesh = CubeOfTriangles();
  const Triangle t = mesh.triangles[0];
  mesh.vertices.emplace_back(5.0f, 5.0f, 5.0f);
  mesh.triangles.push_back({t[1], t[0], 8});
  EXPECT_THAT(InspectMesh(mesh).problem, HasSubstr("belongs to 3 faces"));
}

TEST(Mesh, TheSurfaceOfTwoBoxesIsThatOfBoth) {
  const TriangleMesh two = Joined(CubeOfTriangles(), CubeOfTriangles());
  EXPECT_EQ(two.vertices.size(), 16u);
  EXPECT_EQ(two.triangles[12],
            (Triangle{two.triangles[0][0] + 8, two.triangles[0][1] + 8, two.triangles[0][2] + 8}));
  EXPECT_NEAR(TriangleArea(two, two.triangles[0]), SurfaceArea(CubeOfTriangles()) / 12.0, 1e-6);
  EXPECT_NEAR(SurfaceArea(two), 2.0 * SurfaceArea(CubeOfTriangles()), 1e-6);
}

TEST(InspectMesh, FindsTwoPartsAndPartsThatOnlyTouch) {
  TriangleMesh second = CubeOfTriangles();
  for (Vector3f& v : second.vertices) v.x() += 5.0f;
  const TriangleMesh apart = Joined(CubeOfTriangles(), second);
  const MeshReport report = InspectMesh(apart);
  EXPECT_EQ(report.components, 2);
  EXPECT_EQ(report.euler_characteristic, 4);
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.problem, "expected one surface, found 2");

  TriangleMesh touching = apart;
  for (Triangle& t : touching.triangles) {
    for (std::int32_t& v : t) v = v == 8 ? 0 : v > 8 ? v - 1 : v;
  }
  touching.vertices.erase(touching.vertices.begin() + 8);
  EXPECT_EQ(InspectMesh(touching).components, 1);
  EXPECT_EQ(InspectMesh(touching).problem, "vertex 0 joins two surfaces that only touch there");
}

TEST(InspectMesh, FindsBadVerticesAndTriangles) {
  TriangleMesh mesh = CubeOfTriangles();
  mesh.vertices[5].y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(InspectMesh(mesh).problem, "vertex 5 is not finite");

  mesh = CubeOfTriangles();
  mesh.vertices.emplace_back(0.0f, 0.0f, 0.0f);
  EXPECT_EQ(InspectMesh(mesh).problem, "vertex 8 belongs to no face");

  mesh = CubeOfTriangles();
  mesh.triangles[4][2] = 8;
  EXPECT_EQ(InspectMesh(mesh).problem, "face 4 refers to vertex 8, but there are 8 vertices");
  mesh.triangles[4][2] = -1;
  EXPECT_EQ(InspectMesh(mesh).problem, "face 4 refers to vertex -1, but there are 8 vertices");

  mesh = CubeOfTriangles();
  mesh.triangles[4][2] = mesh.triangles[4][0];
  EXPECT_THAT(InspectMesh(mesh).problem, HasSubstr("face 4 uses vertex"));

  mesh = CubeOfTriangles();
  mesh.vertices[mesh.triangles[0][0]] = mesh.vertices[mesh.triangles[0][1]];
  EXPECT_EQ(InspectMesh(mesh).problem, "triangle 0 has no area");

  EXPECT_EQ(InspectMesh({}).problem, "there are no faces");
  EXPECT_FALSE(InspectMesh({}).closed);
}

}  // namespace
}  // namespace vitruvia
