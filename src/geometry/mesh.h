// Triangle meshes in flat arrays, and quantities computed from them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "math/vector.h"

namespace vitruvia {

using Vector3f = Vector3<float>;
using Vector3d = Vector3<double>;
using Triangle = std::array<std::int32_t, 3>;
using Quad = std::array<std::int32_t, 4>;

struct TriangleMesh {
  std::vector<Vector3f> vertices;   // V, metres
  std::vector<Triangle> triangles;  // counter-clockwise seen from outside
};

// A quad mesh, the input and output of Catmull–Clark subdivision.
struct QuadMesh {
  std::vector<Vector3f> vertices;
  std::vector<Quad> quads;  // counter-clockwise seen from outside
};

TriangleMesh Triangulated(const QuadMesh& mesh);  // each quad split along its shorter diagonal

// Area-weighted vertex normals (V, unit length; zero where a vertex has no area).
void ComputeVertexNormals(const std::vector<Vector3f>& vertices,
                          const std::vector<Triangle>& triangles, std::vector<Vector3f>& normals);

// Adds a surface to `mesh`.
void AppendSurface(const std::vector<Vector3f>& vertices, const std::vector<Triangle>& triangles,
                   TriangleMesh& mesh);

double TriangleArea(const TriangleMesh& mesh, const Triangle& triangle);  // m²
double SurfaceArea(const TriangleMesh& mesh);                             // m²
double EnclosedVolume(const TriangleMesh& mesh);  // m³, divergence theorem; mesh must be closed
Eigen::AlignedBox3f BoundingBox(const std::vector<Vector3f>& vertices);  // empty if there are none
double BoundingBoxDiagonal(const std::vector<Vector3f>& vertices);       // metres

// The requirements of a body mesh. `problem` is "" if the mesh is one closed, consistently oriented
// 2-manifold of finite vertices without degenerate triangles.
struct MeshReport {
  int components = 0;
  int euler_characteristic = 0;
  bool closed = false;
  std::string problem;
};
MeshReport InspectMesh(const TriangleMesh& mesh);

}  // namespace vitruvia
