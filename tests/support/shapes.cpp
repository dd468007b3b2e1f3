#include "support/shapes.h"

#include <numbers>

#include "body/subdivision.h"
#include "core/random.h"

namespace vitruvia::shapes {

QuadMesh Cube() {
  QuadMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back(i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f);
  }
  mesh.quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return mesh;
}

QuadMesh Torus(int around, int along) {
  constexpr double kRadius = 1.0, kTubeRadius = 0.4;
  QuadMesh mesh;
  for (int i = 0; i < around; ++i) {
    const double a = 2.0 * std::numbers::pi * i / around;
    for (int j = 0; j < along; ++j) {
      const double b = 2.0 * std::numbers::pi * j / along;
      const double r = kRadius + kTubeRadius * std::cos(b);
      mesh.vertices.push_back(
          Vector3d(r * std::cos(a), r * std::sin(a), kTubeRadius * std::sin(b)).cast<float>());
      const auto at = [&](int p, int q) { return (i + p) % around * along + (j + q) % along; };
      mesh.quads.push_back({at(0, 0), at(1, 0), at(1, 1), at(0, 1)});
    }
  }
  return mesh;
}

QuadMesh Sphere(int steps) {
  QuadMesh mesh = Cube();
  for (int i = 0; i < steps; ++i) mesh = Subdivided(mesh);
  for (Vector3f& v : mesh.vertices) v.normalize();
  return mesh;
}

QuadMesh Subdivided(const QuadMesh& mesh) {
  const int count = static_cast<int>(mesh.vertices.size());
  const SubdivisionStep step = CatmullClark(mesh.quads, count);
  Eigen::MatrixXf old(count, 3);
  for (int v = 0; v < count; ++v) old.row(v) = mesh.vertices[v].transpose();
  const Eigen::MatrixXf refined = step.new_from_old * old;
  QuadMesh result{{}, step.quads};
  for (Eigen::Index v = 0; v < refined.rows(); ++v) {
    result.vertices.emplace_back(refined.row(v).transpose());
  }
  return result;
}

QuadMesh Shaken(QuadMesh mesh, float amount) {
  RandomStream random(1, "shaken");
  for (Vector3f& v : mesh.vertices) {
    for (float& coordinate : v) {
      coordinate += static_cast<float>(random.Uniform(-amount, amount));
    }
  }
  return mesh;
}

TriangleMesh Joined(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh result = a;
  AppendSurface(b.vertices, b.triangles, result);
  return result;
}

}  // namespace vitruvia::shapes
