#include "geometry/surface_map.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "core/random.h"
#include "support/shapes.h"

namespace vitruvia {
namespace {

Vector3d RandomVector(RandomStream& random, double scale) {
  return scale * Vector3d(random.Normal(), random.Normal(), random.Normal());
}

double DistanceToSegment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const double length_squared = (b - a).squaredNorm();
  if (length_squared == 0.0) return (p - a).norm();
  return (a + std::clamp((p - a).dot(b - a) / length_squared, 0.0, 1.0) * (b - a) - p).norm();
}

// The foot of the perpendicular where it lies inside, the nearest side otherwise.
double DistanceToTriangle(const Vector3d& p, const Vector3d& a, const Vector3d& b,
                          const Vector3d& c) {
  double distance = std::min(
      {DistanceToSegment(p, a, b), DistanceToSegment(p, b, c), DistanceToSegment(p, c, a)});
  const Vector3d normal = (b - a).cross(c - a);
  const bool inside = normal.dot((b - a).cross(p - a)) > 0.0 &&
                      normal.dot((c - b).cross(p - b)) > 0.0 &&
                      normal.dot((a - c).cross(p - c)) > 0.0;
  if (inside) distance = std::min(distance, std::abs(normal.normalized().dot(p - a)));
  return distance;
}

// The distance to the mesh, by trying all triangles.
double BruteForceDistance(const Vector3d& p, const TriangleMesh& mesh) {
  double distance = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : mesh.triangles) {
    distance = std::min(distance, DistanceToTriangle(p, mesh.vertices[a].cast<double>(),
                                                     mesh.vertices[b].cast<double>(),
                                                     mesh.vertices[c].cast<double>()));
  }
  return distance;
}

TriangleMesh TriangleSoup() {
  RandomStream random(1, "soup");
  TriangleMesh mesh;
  for (int v = 0; v < 120; ++v) mesh.vertices.push_back(RandomVector(random, 1.0).cast<float>());
  for (int t = 0; t < 150; ++t) {
    Triangle triangle{};
    for (std::int32_t& v : triangle) v = static_cast<std::int32_t>(random.Index(120));
    mesh.triangles.push_back(triangle);  // some with equal corners: lines
  }
  mesh.triangles.push_back({7, 7, 7});
  return mesh;
}

std::vector<Vector3f> QueriesFor(const TriangleMesh& mesh) {
  RandomStream random(2, "queries");
  std::vector<Vector3f> points = mesh.vertices;
  for (const double scale : {0.01, 0.5, 3.0, 1000.0}) {
    for (int i = 0; i < 60; ++i) points.push_back(RandomVector(random, scale).cast<float>());
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    points.push_back((mesh.vertices[a] + mesh.vertices[b]) / 2.0f);
    points.push_back((mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3.0f);
  }
  points.emplace_back(0.0f, 0.0f, 0.0f);  // as far from all sides of a cube or sphere
  return points;
}

TEST(ClosestSurfacePoints, AreThoseOfBruteForce) {
  for (const TriangleMesh& mesh :
       {Triangulated(shapes::Cube()), Triangulated(shapes::Sphere(2)),
        Triangulated(shapes::Shaken(shapes::Torus(14, 9), 0.05f)), TriangleSoup()}) {
    const std::vector<Vector3f> points = QueriesFor(mesh);
    const std::vector<SurfacePoint> found = ClosestSurfacePoints(points, mesh);
    ASSERT_EQ(found.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& [u, v, w] = found[i].barycentric;
      ASSERT_GE(std::min({u, v, w}), 0.0f) << "point " << i;
      ASSERT_NEAR(u + v + w, 1.0f, 2e-7f);
      const Vector3f on_surface = Evaluate(found[i], mesh.vertices.data(), mesh.triangles);
      const double expected = BruteForceDistance(points[i].cast<double>(), mesh);
      ASSERT_NEAR((on_surface - points[i]).cast<double>().norm(), expected, 1e-6 * (1.0 + expected))
          << "point " << i;
    }
  }
}

TEST(ClosestSurfacePoints, OfSurfacePointsAreThemselves) {
  const TriangleMesh mesh = Triangulated(shapes::Shaken(shapes::Torus(14, 9), 0.05f));
  RandomStream random(3, "on the surface");
  std::vector<SurfacePoint> expected;
  std::vector<Vector3f> points;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const auto a = static_cast<float>(random.Uniform(0.1, 0.45));
    const auto b = static_cast<float>(random.Uniform(0.1, 0.45));
    expected.push_back({t, {a, b, 1.0f - a - b}});
    points.push_back(Evaluate(expected.back(), mesh.vertices.data(), mesh.triangles));
  }
  const std::vector<SurfacePoint> found = ClosestSurfacePoints(points, mesh);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].triangle, expected[i].triangle);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(found[i].barycentric[k], expected[i].barycentric[k], 1e-5f);
    }
  }
}

TEST(ClosestSurfacePoints, OfVerticesAreTheVertices) {
  const TriangleMesh mesh = Triangulated(shapes::Sphere(2));
  for (const SurfacePoint& p : ClosestSurfacePoints(mesh.vertices, mesh)) {
    EXPECT_EQ(*std::max_element(p.barycentric.begin(), p.barycentric.end()), 1.0f);
  }
}

TEST(ClosestSurfacePoints, AmongEqualsTakeTheLowestTriangle) {
  // Six equal triangles one over the other, and far ones so that the tree has branches.
  TriangleMesh mesh = Triangulated(shapes::Cube());
  for (Vector3f& v : mesh.vertices) v += Vector3f(10, 0, 0);
  const auto first = static_cast<std::int32_t>(mesh.triangles.size());
  const auto base = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  for (int copy = 0; copy < 6; ++copy) mesh.triangles.push_back({base, base + 1, base + 2});
  for (const SurfacePoint& p : ClosestSurfacePoints({{0.2f, 0.2f, 1.0f}, {0, 0, 0}}, mesh)) {
    EXPECT_EQ(p.triangle, first);
  }
}

TEST(ClosestSurfacePoints, RefuseMisuse) {
  const TriangleMesh cube = Triangulated(shapes::Cube());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(ClosestSurfacePoints({{nan, 0, 0}}, cube), std::invalid_argument);
  EXPECT_THROW(ClosestSurfacePoints({{0, 0, 0}}, TriangleMesh{}), std::invalid_argument);
  EXPECT_TRUE(ClosestSurfacePoints({}, cube).empty());
}

}  // namespace
}  // namespace vitruvia
