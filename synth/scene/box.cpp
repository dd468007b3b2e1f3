#include "synth/scene/box.h"

#include <array>

namespace vitruvia {

void AddQuad(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d,
             TriangleMesh& mesh) {
  const auto first = static_cast<int>(mesh.vertices.size());
  for (const Vector3d& corner : {a, b, c, d}) mesh.vertices.push_back(corner.cast<float>());
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

void AddBox(const std::function<Vector3d(const Vector3d& sides)>& corner, TriangleMesh& mesh) {
  const auto at = [&](int i) {
    return corner(
        {(i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0, (i & 4) != 0 ? 1.0 : -1.0});
  };
  for (const auto& face : {std::array{0, 1, 3, 2}, std::array{5, 4, 6, 7}, std::array{4, 0, 2, 6},
                           std::array{1, 5, 7, 3}, std::array{2, 3, 7, 6}, std::array{4, 5, 1, 0}})
    AddQuad(at(face[0]), at(face[1]), at(face[2]), at(face[3]), mesh);
}

}  // namespace vitruvia
