#include "body/subdivision.h"

#include <algorithm>
#include <set>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/CatmullClarkT.hh>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "math/rotation.h"
#include "support/shapes.h"

namespace vitruvia {
namespace {

using shapes::Cube;
using shapes::Shaken;
using shapes::Subdivided;
using shapes::Torus;
using testing::HasSubstr;
using testing::ThrowsMessage;

int CountNear(const std::vector<Vector3f>& vertices, const std::vector<float>& sorted_magnitudes) {
  return static_cast<int>(std::count_if(vertices.begin(), vertices.end(), [&](const Vector3f& v) {
    std::array<float, 3> m{std::abs(v.x()), std::abs(v.y()), std::abs(v.z())};
    std::sort(m.begin(), m.end());
    return std::abs(m[0] - sorted_magnitudes[0]) < 1e-6f &&
           std::abs(m[1] - sorted_magnitudes[1]) < 1e-6f &&
           std::abs(m[2] - sorted_magnitudes[2]) < 1e-6f;
  }));
}

TEST(CatmullClark, OfACubeHasTheKnownPositions) {
  const QuadMesh refined = Subdivided(Cube());
  ASSERT_EQ(refined.vertices.size(), 26u);
  ASSERT_EQ(refined.quads.size(), 24u);
  for (int v = 0; v < 8; ++v) {
    EXPECT_TRUE(refined.vertices[v].isApprox(5.0f / 9.0f * Cube().vertices[v], 1e-6f));
  }
  const float c = 5.0f / 9.0f;
  EXPECT_EQ(CountNear(refined.vertices, {c, c, c}), 8);
  EXPECT_EQ(CountNear(refined.vertices, {0.0f, 0.75f, 0.75f}), 12);
  EXPECT_EQ(CountNear(refined.vertices, {0.0f, 0.0f, 1.0f}), 6);
}

TEST(CatmullClark, RowsAreConvexCombinations) {
  for (const QuadMesh& mesh : {Cube(), Torus(7, 5), Subdivided(Cube())}) {
    const auto step = CatmullClark(mesh.quads, static_cast<int>(mesh.vertices.size()));
    ASSERT_EQ(step.new_from_old.cols(), static_cast<Eigen::Index>(mesh.vertices.size()));
    for (Eigen::Index row = 0; row < step.new_from_old.rows(); ++row) {
      EXPECT_NEAR(step.new_from_old.row(row).sum(), 1.0f, 3e-7f) << "row " << row;
      for (decltype(step.new_from_old)::InnerIterator entry(step.new_from_old, row); entry;
           ++entry) {
        EXPECT_GE(entry.value(), 0.0f);
      }
    }
  }
}

TEST(CatmullClark, KeepsTopologyAndOrientation) {
  for (const auto& [start, euler] : {std::pair{Cube(), 2}, {Torus(6, 5), 0}}) {
    QuadMesh mesh = start;
    for (int step = 0; step < 3; ++step) {
      mesh = Subdivided(mesh);
      const MeshReport report = InspectMesh(Triangulated(mesh));
      EXPECT_EQ(report.problem, "");
      EXPECT_EQ(report.euler_characteristic, euler);
      EXPECT_EQ(report.components, 1);
      EXPECT_GT(EnclosedVolume(Triangulated(mesh)), 0.0);
    }
    EXPECT_EQ(mesh.quads.size(), start.quads.size() * 64);
  }
}

TEST(CatmullClark, MovesWithTheMesh) {
  const QuadMesh mesh = Shaken(Torus(8, 6), 0.1f);
  QuadMesh moved = mesh;
  const Matrix3<float> rotation = ExpSo3<float>({0.2f, 0.9f, -0.4f});
  for (Vector3f& v : moved.vertices) v = rotation * v + Vector3f(1, -2, 0.5f);
  const QuadMesh a = Subdivided(mesh), b = Subdivided(moved);
  EXPECT_EQ(a.quads, b.quads);
  for (std::size_t v = 0; v < a.vertices.size(); ++v) {
    EXPECT_LT((rotation * a.vertices[v] + Vector3f(1, -2, 0.5f) - b.vertices[v]).norm(), 2e-6f);
  }
}

// The same surface from OpenMesh's own subdivider, an independent implementation.
QuadMesh SubdividedByOpenMesh(const QuadMesh& mesh) {
  OpenMesh::PolyMesh_ArrayKernelT<> poly;
  std::vector<OpenMesh::VertexHandle> handles;
  for (const Vector3f& v : mesh.vertices) {
    handles.push_back(poly.add_vertex({v.x(), v.y(), v.z()}));
  }
  for (const auto& [a, b, c, d] : mesh.quads) {
    poly.add_face({handles[a], handles[b], handles[c], handles[d]});
  }
  poly.request_face_normals();
  poly.request_vertex_normals();
  OpenMesh::Subdivider::Uniform::CatmullClarkT<OpenMesh::PolyMesh_ArrayKernelT<>> subdivider;
  subdivider.attach(poly);
  subdivider(1);
  subdivider.detach();
  QuadMesh result;
  for (const auto v : poly.vertices()) {
    result.vertices.emplace_back(poly.point(v)[0], poly.point(v)[1], poly.point(v)[2]);
  }
  for (const auto f : poly.faces()) {
    Quad quad{};
    int corner = 0;
    for (const auto v : poly.fv_range(f)) quad.at(corner++) = v.idx();
    result.quads.push_back(quad);
  }
  return result;
}

std::size_t Nearest(const Vector3f& wanted, const std::vector<Vector3f>& vertices) {
  const auto nearest =
      std::min_element(vertices.begin(), vertices.end(), [&](const Vector3f& a, const Vector3f& b) {
        return (a - wanted).squaredNorm() < (b - wanted).squaredNorm();
      });
  return static_cast<std::size_t>(nearest - vertices.begin());
}

// Starting at its lowest index, so that equal quads are equal arrays.
Quad Canonical(Quad quad) {
  std::rotate(quad.begin(), std::min_element(quad.begin(), quad.end()), quad.end());
  return quad;
}

TEST(CatmullClark, AgreesWithOpenMesh) {
  for (const QuadMesh& mesh :
       {Shaken(Cube(), 0.3f), Shaken(Torus(9, 7), 0.05f), Shaken(Subdivided(Cube()), 0.05f)}) {
    const QuadMesh ours = Subdivided(mesh), theirs = SubdividedByOpenMesh(mesh);
    ASSERT_EQ(ours.vertices.size(), theirs.vertices.size());
    std::vector<std::int32_t> ours_from_theirs;
    for (const Vector3f& v : theirs.vertices) {
      const std::size_t nearest = Nearest(v, ours.vertices);
      EXPECT_LT((ours.vertices[nearest] - v).norm(), 2e-6f);
      ours_from_theirs.push_back(static_cast<std::int32_t>(nearest));
    }
    std::set<Quad> expected, found;
    for (const auto& [a, b, c, d] : theirs.quads) {
      expected.insert(Canonical(
          {ours_from_theirs[a], ours_from_theirs[b], ours_from_theirs[c], ours_from_theirs[d]}));
    }
    for (const Quad& quad : ours.quads) found.insert(Canonical(quad));
    EXPECT_EQ(found, expected);
  }
}

TEST(CatmullClark, RefusesWhatIsNotAClosedManifold) {
  QuadMesh open = Cube();
  open.quads.pop_back();
  EXPECT_THAT([&] { CatmullClark(open.quads, 8); },
              ThrowsMessage<DataError>(HasSubstr("cannot be subdivided: open edge")));
  QuadMesh turned = Cube();
  std::reverse(turned.quads[2].begin(), turned.quads[2].end());
  EXPECT_THAT([&] { CatmullClark(turned.quads, 8); },
              ThrowsMessage<DataError>(HasSubstr("oriented against each other")));
  EXPECT_THAT([&] { CatmullClark(Cube().quads, 7); },
              ThrowsMessage<DataError>(HasSubstr("but there are 7 vertices")));
  EXPECT_THAT([&] { CatmullClark(Cube().quads, 9); },
              ThrowsMessage<DataError>(HasSubstr("vertex 8 belongs to no face")));
  EXPECT_THAT([&] { CatmullClark({}, 0); },
              ThrowsMessage<DataError>(HasSubstr("there are no faces")));
}

}  // namespace
}  // namespace vitruvia
