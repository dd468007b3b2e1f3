#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "learning/scan/body_check.h"
#include "learning/scan/scan_surface.h"
#include "support/shapes.h"
#include "support/tiny_body.h"

namespace vitruvia {
namespace {

using shapes::Joined;
using testing::HasSubstr;
using testing::SizeIs;

RawSurface Raw(TriangleMesh mesh) {
  const std::size_t count = mesh.vertices.size();
  return {std::move(mesh), std::vector<float>(count, 1.0f)};
}

TriangleMesh Moved(TriangleMesh mesh, const Vector3f& by) {
  for (Vector3f& p : mesh.vertices) p += by;
  return mesh;
}

TriangleMesh Tetrahedron(float size) {
  return {{{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

// Without the triangles that have a corner above `height`.
TriangleMesh CutAbove(TriangleMesh mesh, float height) {
  std::vector<Triangle> kept;
  for (const Triangle& t : mesh.triangles) {
    if (mesh.vertices[t[0]].y() <= height && mesh.vertices[t[1]].y() <= height &&
        mesh.vertices[t[2]].y() <= height) {
      kept.push_back(t);
    }
  }
  mesh.triangles = kept;
  return mesh;
}

TEST(Cleaned, DropsIslandsAndSaysWhatTheyWere) {
  const TriangleMesh large = Tetrahedron(1.0f);
  const ScanSurface surface =
      Cleaned(Raw(Joined(Moved(Tetrahedron(0.05f), {3, 0, 0}), large)), 0.0, 0.02);
  ASSERT_THAT(surface.components, SizeIs(2));
  EXPECT_NEAR(surface.components[0].area_m2, 1.5 + std::sqrt(3.0) / 2.0, 1e-6);
  EXPECT_NEAR(surface.components[1].area_m2, 0.0025 * (1.5 + std::sqrt(3.0) / 2.0), 1e-8);
  EXPECT_TRUE(surface.components[0].kept);
  EXPECT_FALSE(surface.components[1].kept);
  EXPECT_EQ(surface.components[1].box.min(), Vector3f(3, 0, 0));
  EXPECT_THAT(surface.mesh.vertices, testing::ElementsAreArray(large.vertices));
  EXPECT_THAT(surface.mesh.triangles, SizeIs(4));
  EXPECT_THAT(surface.weights, SizeIs(4));
  EXPECT_TRUE(surface.holes.empty());
}

TEST(Cleaned, ContractsShortEdgesAndDropsTrianglesWithoutArea) {
  TriangleMesh mesh = Tetrahedron(1.0f);
  // Split the edge 1–2 next to vertex 1: two slivers.
  mesh.vertices.push_back({1.0f - 1e-5f, 1e-5f, 0.0f});
  mesh.triangles = {{0, 2, 4}, {0, 4, 1}, {0, 1, 3}, {0, 3, 2}, {1, 4, 3}, {4, 2, 3}};
  const ScanSurface surface = Cleaned(Raw(mesh), 1e-3, 0.0);
  EXPECT_THAT(surface.mesh.vertices, SizeIs(4));
  EXPECT_THAT(surface.mesh.triangles, SizeIs(4));
  EXPECT_EQ(InspectMesh(surface.mesh).problem, "");
}

TEST(Cleaned, NormalsPointOutwards) {
  const ScanSurface surface = Cleaned(Raw(Tetrahedron(1.0f)), 0.0, 0.0);
  const Vector3f middle(0.25f, 0.25f, 0.25f);
  for (std::size_t i = 0; i < surface.normals.size(); ++i) {
    EXPECT_GT(surface.normals[i].dot(surface.mesh.vertices[i] - middle), 0.0f);
  }
}

TEST(BoundaryLoops, MeasureAHole) {
  TriangleMesh mesh = Tetrahedron(1.0f);
  mesh.triangles.pop_back();
  const std::vector<BoundaryLoop> loops = FindBoundaryLoops(mesh);
  ASSERT_THAT(loops, SizeIs(1));
  EXPECT_EQ(loops[0].edges, 3);
  EXPECT_NEAR(loops[0].perimeter_m, 3.0 * std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(loops[0].area_m2, std::sqrt(3.0) / 2.0, 1e-6);
  EXPECT_LT((loops[0].center - Vector3f::Constant(1.0f / 3.0f)).norm(), 1e-6f);
  EXPECT_TRUE(FindBoundaryLoops(Tetrahedron(1.0f)).empty());
}

TEST(BodyCheck, AcceptsAWholeBody) {
  RequireOneWholeBody(Cleaned(Raw(TinyBody(2).rest), 0.0, 0.02), {});
}

void ExpectRefusal(const RawSurface& raw, const std::string& words) {
  try {
    RequireOneWholeBody(Cleaned(raw, 0.0, 0.02), {});
    FAIL() << "accepted, expected: " << words;
  } catch (const DataError& error) {
    EXPECT_THAT(error.what(), HasSubstr(words));
  }
}

TEST(BodyCheck, RefusesNoBody) {
  ExpectRefusal({}, "no body: the largest surface found has 0.000 m²");
  ExpectRefusal(Raw(Tetrahedron(0.1f)), "no body");
}

TEST(BodyCheck, RefusesTwoBodies) {
  const TriangleMesh body = TinyBody(2).rest;
  ExpectRefusal(Raw(Joined(body, Moved(body, {0, 0, -1}))), "two bodies");
}

TEST(BodyCheck, RefusesAHoleForAHead) {
  ExpectRefusal(Raw(CutAbove(TinyBody(4).rest, 1.6f)), "a hole for a head");
}

}  // namespace
}  // namespace vitruvia
