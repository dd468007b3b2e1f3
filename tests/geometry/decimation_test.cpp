#include "geometry/decimation.h"

#include <algorithm>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "support/shapes.h"

namespace vitruvia {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TriangleMesh Decimated(const TriangleMesh& mesh, int target_vertices) {
  Decimation decimation = Decimate(mesh, target_vertices);
  TriangleMesh result;
  for (const int v : decimation.kept) result.vertices.push_back(mesh.vertices[v]);
  result.triangles = std::move(decimation.triangles);
  return result;
}

// Every triangle cut into four at its edges' middles: the same surface with more vertices.
TriangleMesh Cut(const TriangleMesh& mesh) {
  TriangleMesh result{mesh.vertices, {}};
  std::map<std::pair<int, int>, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b) {
    const auto [found, added] = middles.try_emplace(std::minmax(a, b), result.vertices.size());
    if (added) result.vertices.push_back(0.5f * (mesh.vertices[a] + mesh.vertices[b]));
    return found->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Triangle& t :
         {Triangle{a, ab, ca}, Triangle{ab, b, bc}, Triangle{ca, bc, c}, Triangle{ab, bc, ca}}) {
      result.triangles.push_back(t);
    }
  }
  return result;
}

TEST(Decimation, KeepsExactlyTheAskedNumberOfVerticesOfAClosedSurface) {
  const TriangleMesh sphere = Triangulated(shapes::Sphere(4));
  ASSERT_EQ(sphere.vertices.size(), 1538u);
  for (const int target : {1000, 400, 100}) {
    const TriangleMesh mesh = Decimated(sphere, target);
    EXPECT_EQ(mesh.vertices.size(), static_cast<std::size_t>(target));
    EXPECT_EQ(mesh.triangles.size(), static_cast<std::size_t>(2 * target - 4));  // Euler
    const MeshReport report = InspectMesh(mesh);
    EXPECT_EQ(report.problem, "");
    EXPECT_EQ(report.euler_characteristic, 2);
  }
}

TEST(Decimation, KeepsTheShape) {
  const TriangleMesh sphere = Triangulated(shapes::Sphere(4));
  // A polyhedron of n well-spread vertices on a sphere misses about 2π/√3/n of its volume: 0.9 %
  // here, of which the finer sphere misses a quarter itself.
  const double volume = EnclosedVolume(Decimated(sphere, 400));
  EXPECT_LT(volume, EnclosedVolume(sphere));
  EXPECT_NEAR(volume, EnclosedVolume(sphere), 0.02 * EnclosedVolume(sphere));

  const TriangleMesh torus = Decimated(Triangulated(shapes::Torus(32, 24)), 300);
  EXPECT_EQ(torus.vertices.size(), 300u);
  EXPECT_EQ(InspectMesh(torus).problem, "");
  EXPECT_EQ(InspectMesh(torus).euler_characteristic, 0);
}

TEST(Decimation, TakesFlatPlacesFirstAndKeepsCorners) {
  const TriangleMesh cube = Cut(Cut(Cut(Triangulated(shapes::Cube()))));
  ASSERT_EQ(cube.vertices.size(), 386u);
  const TriangleMesh mesh = Decimated(cube, 40);
  EXPECT_EQ(mesh.vertices.size(), 40u);
  EXPECT_NEAR(EnclosedVolume(mesh), 8.0, 1e-6);
  const auto corners = std::ranges::count_if(
      mesh.vertices, [](const Vector3f& v) { return v.cwiseAbs().minCoeff() == 1.0f; });
  EXPECT_EQ(corners, 8);
}

TEST(Decimation, IsTheSameEveryTime) {
  const TriangleMesh mesh = Triangulated(shapes::Shaken(shapes::Sphere(3), 0.01f));
  const Decimation first = Decimate(mesh, 150), second = Decimate(mesh, 150);
  EXPECT_EQ(first.kept, second.kept);
  EXPECT_EQ(first.triangles, second.triangles);
  EXPECT_TRUE(std::ranges::is_sorted(first.kept));
}

TEST(Decimation, LeavesAMeshOfFewerVerticesAsItIs) {
  const TriangleMesh mesh = Triangulated(shapes::Sphere(2));
  const Decimation decimation = Decimate(mesh, 1000);
  EXPECT_EQ(decimation.kept.size(), mesh.vertices.size());
  EXPECT_EQ(decimation.triangles.size(), mesh.triangles.size());
  EXPECT_NEAR(EnclosedVolume({mesh.vertices, decimation.triangles}), EnclosedVolume(mesh), 1e-9);
}

TEST(Decimation, RefusesWhatIsNotClosed) {
  TriangleMesh open = Triangulated(shapes::Sphere(2));
  open.triangles.pop_back();
  EXPECT_THAT([&] { Decimate(open, 20); },
              ThrowsMessage<DataError>(HasSubstr("mesh to be decimated")));
  EXPECT_THROW(Decimate(Triangulated(shapes::Cube()), 3), std::invalid_argument);
}

}  // namespace
}  // namespace vitruvia
