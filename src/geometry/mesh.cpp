#include "geometry/mesh.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "core/disjoint_sets.h"
#include "geometry/half_edges.h"

// Precision: vertices are float (0.1 µm at 1 m), as depth and skinning are. Whatever sums over a
// whole mesh (volume) or compares nearly equal lengths (degeneracy) does so in double. Normals only
// sum over a vertex's few triangles and are made once per frame: float.
namespace vitruvia {
namespace {

// A triangle whose height is less than this share of its longest side has, in float, no normal.
constexpr double kSmallestHeightOfSide = std::numeric_limits<float>::epsilon();

bool IsDegenerate(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double longest_squared =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  const double twice_area = (b - a).cross(c - a).norm();
  return !(twice_area > kSmallestHeightOfSide * longest_squared);
}

std::string ShapeProblem(const TriangleMesh& mesh) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!mesh.vertices[v].allFinite()) return fmt::format("vertex {} is not finite", v);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    if (IsDegenerate(mesh.vertices[a].cast<double>(), mesh.vertices[b].cast<double>(),
                     mesh.vertices[c].cast<double>())) {
      return fmt::format("triangle {} has no area", t);
    }
  }
  return "";
}

// Connected parts, of which a vertex without triangles is one.
int CountComponents(const TriangleMesh& mesh) {
  DisjointSets sets(mesh.vertices.size());
  int components = static_cast<int>(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    for (const int other : {t[1], t[2]}) components -= sets.Join(t[0], other) ? 1 : 0;
  }
  return components;
}

bool IndicesInRange(const TriangleMesh& mesh) {
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](std::int32_t v) {
      return v >= 0 && static_cast<std::size_t>(v) < mesh.vertices.size();
    });
  });
}

}  // namespace

TriangleMesh Triangulated(const QuadMesh& mesh) {
  TriangleMesh result;
  result.vertices = mesh.vertices;
  result.triangles.reserve(2 * mesh.quads.size());
  for (const auto& [a, b, c, d] : mesh.quads) {
    const auto squared_length = [&](int p, int q) {
      return (mesh.vertices[p] - mesh.vertices[q]).squaredNorm();
    };
    if (squared_length(a, c) <= squared_length(b, d)) {
      result.triangles.push_back({a, b, c});
      result.triangles.push_back({a, c, d});
    } else {
      result.triangles.push_back({a, b, d});
      result.triangles.push_back({b, c, d});
    }
  }
  return result;
}

void ComputeVertexNormals(const std::vector<Vector3f>& vertices,
                          const std::vector<Triangle>& triangles, std::vector<Vector3f>& normals) {
  normals.assign(vertices.size(), Vector3f::Zero());
  for (const auto& [a, b, c] : triangles) {
    const Vector3f twice_area =
        (vertices[b] - vertices[a]).cross(Vector3f(vertices[c] - vertices[a]));
    normals[a] += twice_area;
    normals[b] += twice_area;
    normals[c] += twice_area;
  }
  for (Vector3f& normal : normals) {
    const float length = normal.norm();
    if (length > 0.0f) normal /= length;
  }
}

void AppendSurface(const std::vector<Vector3f>& vertices, const std::vector<Triangle>& triangles,
                   TriangleMesh& mesh) {
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), vertices.begin(), vertices.end());
  for (const auto& [a, b, c] : triangles)
    mesh.triangles.push_back({a + first, b + first, c + first});
}

double TriangleArea(const TriangleMesh& mesh, const Triangle& triangle) {
  const Vector3d a = mesh.vertices[triangle[0]].cast<double>();
  return 0.5 * (mesh.vertices[triangle[1]].cast<double>() - a)
                   .cross(mesh.vertices[triangle[2]].cast<double>() - a)
                   .norm();
}

double SurfaceArea(const TriangleMesh& mesh) {
  double area_m2 = 0.0;
  for (const Triangle& t : mesh.triangles) area_m2 += TriangleArea(mesh, t);
  return area_m2;
}

double EnclosedVolume(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return 0.0;
  const Vector3d origin = mesh.vertices.front().cast<double>();  // near the mesh: less cancellation
  double six_volumes = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    six_volumes += (mesh.vertices[a].cast<double>() - origin)
                       .dot((mesh.vertices[b].cast<double>() - origin)
                                .cross(Vector3d(mesh.vertices[c].cast<double>() - origin)));
  }
  return six_volumes / 6.0;
}

Eigen::AlignedBox3f BoundingBox(const std::vector<Vector3f>& vertices) {
  Eigen::AlignedBox3f box;
  for (const Vector3f& v : vertices) box.extend(v);
  return box;
}

double BoundingBoxDiagonal(const std::vector<Vector3f>& vertices) {
  if (vertices.empty()) return 0.0;
  const Eigen::AlignedBox3f box = BoundingBox(vertices);
  return (box.max().cast<double>() - box.min().cast<double>()).norm();
}

MeshReport InspectMesh(const TriangleMesh& mesh) {
  const HalfEdges half_edges = FindHalfEdges(mesh.triangles, mesh.vertices.size());
  MeshReport report;
  report.closed = half_edges.closed;
  report.euler_characteristic = static_cast<int>(mesh.vertices.size()) - half_edges.edge_count +
                                static_cast<int>(mesh.triangles.size());
  report.problem = half_edges.problem;
  if (!IndicesInRange(mesh)) return report;
  report.components = CountComponents(mesh);
  if (report.problem.empty() && report.components != 1) {
    report.problem = fmt::format("expected one surface, found {}", report.components);
  }
  if (report.problem.empty()) report.problem = ShapeProblem(mesh);
  return report;
}

}  // namespace vitruvia
